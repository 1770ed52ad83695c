#include "rehearse/core/ranks.hpp"

#include <algorithm>
#include <cstring>
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

// A message is: the length of the step's name, the name, and what is given.
std::vector<std::string> Ranks::exchange(std::string_view step, std::string_view bytes) {
  if (over_) throw std::runtime_error("the ranks have parted");
  const std::string mine = bytes_of(step.size()).append(step).append(bytes);
  std::vector<std::string> given = carry(mine);
  std::vector<std::string> steps;
  for (std::string& message : given) {
    std::string_view rest = message;
    const auto length = take<std::size_t>(rest);
    steps.emplace_back(rest.substr(0, length));
    message = rest.substr(length);
  }
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

}  // namespace rehearse
