#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "rehearse/system/answers.hpp"

namespace rehearse::system {

/// A program that runs beside this one, with its standard streams in our hands; started without a shell, in a process
/// group of its own, which is killed with this object. A program that was never late or wrong is first left to end by
/// itself, so that a robot's driver can take the torque off. What it writes to standard error is read all the time, and
/// its end is kept. One thread.
class Process {
 public:
  /// command: the program, as the shell's PATH finds it or by its path from the folder, and its arguments. folder:
  /// where it runs. Throws std::system_error if it cannot be started.
  Process(const std::vector<std::string>& command, const std::filesystem::path& folder);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// unasked: an answer was there before the message was sent.
  enum class Outcome { answered, wrong, unasked, ended, late, flooded };

  /// Finds the answer in the program's unused output: the number of its bytes, 0 if some are still to come, kNoAnswer
  /// if it is none.
  using Complete = std::function<std::size_t(std::string_view)>;

  /// Sends a message and waits for the answer, so long and so many bytes at most. The answer stands in `answer`.
  struct Limits {
    double seconds = 10;
    std::size_t bytes = 1 << 20;
  };
  Outcome exchange(std::string_view message, const Complete& complete, Limits limits);
  std::string_view answer() const { return answer_; }

  /// The beginning of its unused output, for messages.
  std::string unused() const;

  /// The last lines that it wrote to standard error, perhaps cut; and how it ended, or nothing while it runs.
  const std::string& last_words() const { return errors_; }
  std::string end();

  /// Ends its input. The destructor does so, too, and waits at most a second from then on before it kills: who owns
  /// several programs ends the inputs of all first, and waits once.
  void leave() noexcept;

  /// Says that its answer was wrong: the destructor kills it at once.
  void distrust() { trusted_ = false; }

 private:
  Outcome heard(std::string_view message, const Complete& complete, Limits limits);
  void await_end() noexcept;
  bool has_unasked_answer(const Complete& complete, std::size_t most);
  bool send(std::string_view& left);
  bool receive();
  void read_errors();

  pid_t process_ = -1;
  int input_ = -1, output_ = -1, error_ = -1;
  bool input_open_ = true, spoken_ = false, trusted_ = true;
  std::optional<std::chrono::steady_clock::time_point> left_at_;  // its input was ended
  std::string received_, answer_, errors_;
};

/// Ends the inputs of all objects' programs, waits at most a second until they have ended, and kills them, each with
/// its group. For a process that ends right after it, without their destructors. It may be called in a handler of
/// signals.
void kill_programs() noexcept;

}  // namespace rehearse::system
