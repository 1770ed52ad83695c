#pragma once
// The exchange of messages with one running program. For the sources of this room.

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "rehearse/core/types.hpp"
#include "rehearse/system/messages.hpp"
#include "rehearse/system/process.hpp"
#include "rehearse/system/program.hpp"

namespace rehearse::system {

class Conversation {
 public:
  /// Starts the program and says hello. Where that fails, `problem` says why, and nothing else may be called.
  explicit Conversation(const Program& program);

  const std::string& problem() const { return problem_; }  // empty: all is well
  bool late() const { return late_; }                      // the last answer did not come in time
  bool declined() const { return declined_; }              // the last answer was an error, and all is well but for it
  bool has_episodes() const { return has_episodes_; }      // it can reset and step

  /// False, and `problem` says so: it can be asked for no changes of state.
  bool require_changes();

  /// Changes dX (n × dx); n from 1 to kMostRows. False: see `problem`.
  bool change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX);
  static constexpr Index kMostRows = 1024;

  /// The state of a robot that keeps its own. Empty: see `problem`.
  std::optional<messages::State> reset(const Vector& start, const Vector& phi, std::uint64_t seed);
  std::optional<messages::State> step(const Vector& u);

  /// Says that the episode is over, to a program that understands it. False: see `problem`.
  bool end();

  /// Ends the program's input, so that it may end before this object waits for that. Nothing else may be called.
  void leave() noexcept {
    if (process_) process_->leave();
  }

 private:
  using Fault = std::function<std::string(std::string_view written)>;  // why that is no answer, for people
  static std::string is_other(std::string_view written);
  bool hear(std::string_view message, const Process::Complete& complete, Process::Limits limits,
            const Fault& fault = is_other);
  bool greet();
  template <class Read>
  bool ask(std::string_view message, Process::Limits limits, Read read);
  std::optional<messages::State> state_after(const std::string& message);
  bool change_in_doubles(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX);
  bool change_in_json(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX);
  bool wrong(const std::string& why);

  Program program_;
  std::optional<Process> process_;
  std::string problem_, message_;
  bool late_ = false, declined_ = false, doubles_ = false, has_changes_ = true, has_episodes_ = false, has_end_ = false;
};

}  // namespace rehearse::system
