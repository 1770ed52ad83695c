#include "rehearse/core/ranks.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/events.hpp"

namespace rehearse {
namespace {

constexpr std::string_view kLeave = "leave";

template <class T>
std::string bytes_of(const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

/// Takes a value from the front of the bytes.
template <class T>
T take(std::string_view& bytes) {
  T value;
  if (bytes.size() < sizeof value) throw std::runtime_error("a message of another rank is too short");
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

/// An exception as bytes: its kind and its message.
std::string to_bytes(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const Interrupted&) {
    return "s";
  } catch (const InvalidInput& error) {
    return std::string("i") + error.what();
  } catch (const std::exception& error) {
    return std::string("e") + error.what();
  } catch (...) {
    return "eunknown exception";
  }
}

[[noreturn]] void throw_from(std::string_view bytes) {
  const std::string message(bytes.substr(1));
  if (bytes.front() == 's') throw Interrupted{};
  if (bytes.front() == 'i') throw InvalidInput(message);
  throw std::runtime_error(message);
}

}  // namespace

// A message is: whether this rank was asked to stop, the length of the step's name, the name, and what is given.
std::vector<std::string> Ranks::exchange(std::string_view step, std::string_view bytes) {
  if (over_) throw std::runtime_error("the ranks have parted");
  std::string mine(1, stop_ && stop_() ? 1 : 0);
  mine.append(bytes_of(step.size())).append(step).append(bytes);
  std::vector<std::string> given = carry(mine);
  std::vector<std::string> steps;
  bool stopped = stopped_;
  for (std::string& message : given) {
    std::string_view rest = message;
    stopped = take<char>(rest) != 0 || stopped;
    const auto length = take<std::size_t>(rest);
    steps.emplace_back(rest.substr(0, length));
    message = rest.substr(length);
  }
  stopped_ = stopped;
  check_steps(step, steps, given);
  return given;
}

/// All ranks see the same messages, so that either all of them or none come to the end here.
void Ranks::check_steps(std::string_view step, const std::vector<std::string>& steps,
                        const std::vector<std::string>& given) {
  const auto other = std::find_if(steps.begin(), steps.end(), [&](const std::string& s) { return s != step; });
  if (other == steps.end()) return;
  over_ = true;
  if (step == kLeave) return;
  const auto left = std::find(steps.begin(), steps.end(), kLeave);
  if (left == steps.end())
    throw std::runtime_error(fmt::format("the ranks do not compute the same: rank {} is at '{}', rank {} at '{}'",
                                         rank(), step, other - steps.begin(), *other));
  const auto which = left - steps.begin();
  const std::string_view message = std::string_view(given[static_cast<std::size_t>(which)]).substr(sizeof(End::code));
  throw std::runtime_error(message.empty() ? fmt::format("rank {} ended before the others", which)
                                           : fmt::format("rank {} failed: {}", which, message));
}

std::string Ranks::once(std::string_view step, const std::function<std::string()>& work) {
  std::string mine;
  if (rank() == 0) {
    try {
      mine.append("v").append(work());
    } catch (...) {
      mine = to_bytes(std::current_exception());
    }
  }
  std::string first = std::move(exchange(step, mine).front());
  if (first.front() != 'v') throw_from(first);
  first.erase(0, 1);
  return first;
}

std::vector<Ranks::End> Ranks::leave(int code, const std::string& message) {
  if (over_) return {{rank(), code, message}};
  const std::vector<std::string> given = exchange(kLeave, bytes_of(code) + message);
  if (over_) return {{rank(), code, message}};  // the others had not come to the end
  over_ = true;
  std::vector<End> ends;
  for (std::string_view end : given) {
    const int its_code = take<int>(end);
    ends.push_back({static_cast<int>(ends.size()), its_code, std::string(end)});
  }
  return ends;
}

namespace {

/// How many tasks of this thread's are under way, one within the other.
thread_local int depth = 0;

struct WithinTask {
  WithinTask() { ++depth; }
  ~WithinTask() { --depth; }
  WithinTask(const WithinTask&) = delete;
  WithinTask& operator=(const WithinTask&) = delete;
};

class RankEvaluator final : public Evaluator {
 public:
  RankEvaluator(Ranks& ranks, int threads) : ranks_(ranks), here_(make_thread_evaluator(threads)) {
    ends_.push_back(0);
    for (std::string_view their : ranks.exchange("threads", bytes_of(here_->concurrency())))
      ends_.push_back(ends_.back() + take<int>(their));
  }

  /// A block of the columns on each rank, as long as it has threads; then every rank gives its block to all.
  void evaluate(const std::function<void(Index, VectorView)>& task, MatrixView results) const override {
    if (depth > 0) return evaluate_here(task, results);
    const auto [first, end] = block(ranks_.rank(), results.cols());
    const std::string step = fmt::format("evaluate {} x {}", results.rows(), results.cols());
    const std::vector<std::string> given = ranks_.exchange(step, work(task, results, first, end));
    throw_first_failure(given);
    for (int rank = 0; rank < ranks_.size(); ++rank) {
      if (rank == ranks_.rank()) continue;
      const auto [from, to] = block(rank, results.cols());
      read(std::string_view(given[static_cast<std::size_t>(rank)]).substr(1), results.middleCols(from, to - from));
    }
  }

  void for_each(Index n, const std::function<void(Index)>& task) const override {
    here_->for_each(n, [&](Index i) {
      const WithinTask within;
      task(i);
    });
  }

  std::string once(std::string_view step, const std::function<std::string()>& work) const override {
    return ranks_.once(step, work);
  }

  int concurrency() const override { return ends_.back(); }

 private:
  struct Block {
    Index first, end;
  };

  Block block(int rank, Index n) const {
    const auto at = [&](int i) { return n * ends_[static_cast<std::size_t>(i)] / ends_.back(); };
    return {at(rank), at(rank + 1)};
  }

  void evaluate_here(const std::function<void(Index, VectorView)>& task, MatrixView results) const {
    for_each(results.cols(), [&](Index i) { task(i, results.col(i)); });
  }

  /// "v" and the columns, or "f", the first task that failed, and why.
  std::string work(const std::function<void(Index, VectorView)>& task, MatrixView results, Index first,
                   Index end) const {
    std::vector<std::string> failures(static_cast<std::size_t>(end - first));
    for_each(end - first, [&](Index i) {
      try {
        task(first + i, results.col(first + i));
      } catch (...) {
        failures[static_cast<std::size_t>(i)] = to_bytes(std::current_exception());
      }
    });
    for (Index i = first; i < end; ++i)
      if (const std::string& failure = failures[static_cast<std::size_t>(i - first)]; !failure.empty())
        return std::string("f").append(bytes_of(i)).append(failure);
    std::string bytes = "v";
    for (Index i = first; i < end; ++i)
      bytes.append(reinterpret_cast<const char*>(results.col(i).data()), column_bytes(results));
    return bytes;
  }

  static std::size_t column_bytes(const MatrixView& results) {
    return static_cast<std::size_t>(results.rows()) * sizeof(double);
  }

  static void read(std::string_view bytes, MatrixView columns) {
    const std::size_t size = column_bytes(columns);
    for (Index i = 0; i < columns.cols() && size > 0; ++i)
      std::memcpy(columns.col(i).data(), bytes.data() + static_cast<std::size_t>(i) * size, size);
  }

  static void throw_first_failure(const std::vector<std::string>& given) {
    Index earliest = std::numeric_limits<Index>::max();
    std::string_view failure;
    for (std::string_view bytes : given) {
      if (bytes.front() != 'f') continue;
      bytes.remove_prefix(1);
      const auto task = take<Index>(bytes);
      if (task < earliest) earliest = task, failure = bytes;
    }
    if (!failure.empty()) throw_from(failure);
  }

  Ranks& ranks_;
  std::unique_ptr<Evaluator> here_;
  std::vector<int> ends_;  // threads of the ranks before rank i
};

}  // namespace

std::unique_ptr<Evaluator> make_rank_evaluator(Ranks& ranks, int threads) {
  return std::make_unique<RankEvaluator>(ranks, threads);
}

}  // namespace rehearse
