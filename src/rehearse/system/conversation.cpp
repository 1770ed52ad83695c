#include "rehearse/system/conversation.hpp"

#include <system_error>

#include <fmt/format.h>

#include "rehearse/system/answers.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::system {
namespace {

constexpr std::size_t kWords = 1 << 20;  // bytes that a program may print beside an answer

}  // namespace

Conversation::Conversation(const Program& program) : program_(program) {
  try {
    process_.emplace(program.command, program.folder);
    if (!greet()) process_.reset();
  } catch (const std::system_error& error) {
    problem_ = error.what();
  }
}

bool Conversation::wrong(const std::string& why) {
  problem_ = fmt::format("the program '{}': {}", fmt::join(program_.command, " "), why);
  if (process_ && !process_->last_words().empty()) {
    std::string words = process_->last_words();
    while (!words.empty() && words.back() == '\n') words.pop_back();
    problem_ += "; its standard error ends with\n" + words;
  }
  return false;
}

std::string Conversation::is_other(std::string_view written) {
  return fmt::format("it wrote something else than the answer: {}", messages::excerpt(written));
}

/// Sends, and waits for an answer; it stands in the process.
bool Conversation::hear(std::string_view message, const Process::Complete& complete, Process::Limits limits,
                        const Fault& fault) {
  switch (process_->exchange(message, complete, limits)) {
    case Process::Outcome::answered:
      return true;
    case Process::Outcome::ended:
      return wrong(process_->end());
    case Process::Outcome::wrong:
      return wrong(fault(process_->unused()));
    case Process::Outcome::unasked:
      wrong(
          fmt::format("it wrote an answer that nobody asked for, so answers before may be those of other messages: {}",
                      messages::excerpt(process_->unused())));
      throw Unavailable(problem_);  // another process would do the same
    case Process::Outcome::flooded:
      return wrong(fmt::format("it wrote more than {} bytes without an answer: {}", limits.bytes,
                               messages::excerpt(process_->unused())));
    case Process::Outcome::late:
      break;
  }
  late_ = true;
  const std::string written = process_->unused();
  return wrong(fmt::format("it did not answer within {:g} s{}", limits.seconds,
                           written.empty() ? "" : "; it wrote: " + messages::excerpt(written)));
}

/// Sends a line, and reads the line of the answer by read(text), which throws std::runtime_error where it is wrong.
template <class Read>
bool Conversation::ask(std::string_view message, Process::Limits limits, Read read) {
  declined_ = false;
  if (!hear(message, object_line, limits)) return false;
  try {
    read(last_line(process_->answer()));
    return true;
  } catch (const messages::Declined& error) {
    declined_ = true;
    return wrong(error.what());
  } catch (const std::runtime_error& error) {
    process_->distrust();
    return wrong(error.what());
  }
}

bool Conversation::greet() {
  return ask(messages::hello(program_), {program_.start_s, kWords}, [&](std::string_view answer) {
    const messages::Hello hello = messages::read_hello(answer, program_);
    doubles_ = hello.doubles, has_changes_ = hello.change, has_episodes_ = hello.reset, has_end_ = hello.end;
  });
}

bool Conversation::require_changes() {
  return has_changes_ || wrong("it does not understand the message \"change\", so it can be a plant but not a prior");
}

bool Conversation::change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) {
  if (!require_changes()) return false;
  return doubles_ ? change_in_doubles(X, U, phi, dX) : change_in_json(X, U, phi, dX);
}

bool Conversation::change_in_doubles(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi,
                                     MatrixView dX) {
  write_frame(message_, X, U, phi);
  const auto complete = [&](std::string_view written) { return frame_end(written, dX.rows(), dX.cols()); };
  const auto fault = [&](std::string_view written) {
    const std::string why = frame_fault(written, dX.rows(), dX.cols());
    return why.empty() ? is_other(written) : why;
  };
  if (!hear(message_, complete, {program_.answer_s, frame_size(dX.rows(), dX.cols())}, fault)) return false;
  read_frame(process_->answer(), dX);
  return true;
}

bool Conversation::change_in_json(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi,
                                  MatrixView dX) {
  const std::size_t numbers = 64 * static_cast<std::size_t>(dX.size());  // bytes, generously
  return ask(messages::change(X, U, phi), {program_.answer_s, kWords + numbers},
             [&](std::string_view answer) { messages::read_change(answer, dX); });
}

std::optional<messages::State> Conversation::state_after(const std::string& message) {
  std::optional<messages::State> state;
  ask(message, {program_.answer_s, kWords}, [&](std::string_view answer) {
    state = messages::read_state(answer, static_cast<Index>(program_.states.size()));
  });
  return state;
}

std::optional<messages::State> Conversation::reset(const Vector& start, const Vector& phi, std::uint64_t seed) {
  return state_after(messages::reset(start, phi, seed));
}

std::optional<messages::State> Conversation::step(const Vector& u) { return state_after(messages::step(u)); }

bool Conversation::end() { return !has_end_ || ask(messages::end(), {program_.answer_s, kWords}, messages::read_end); }

}  // namespace rehearse::system
