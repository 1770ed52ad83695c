#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace rehearse::apps {

/// Standard output with a last line that is rewritten as work goes on. Where it is no terminal but a file or a pipe,
/// that line goes to standard error, when nothing was said for as long as `silence`.
class StatusLine {
 public:
  explicit StatusLine(std::chrono::milliseconds silence = std::chrono::minutes(1));

  /// A line that stays.
  void print(const std::string& line);

  /// True if `show` would say something: on a terminal at most ten times a second. Never in a rank of several.
  bool is_due() const;
  void show(const std::string& line);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_, alone_;
  bool shown_ = false;
  std::chrono::milliseconds silence_;
  Clock::time_point last_ = Clock::now();
};

/// "45 s", "12 min", "3.1 h"
std::string duration_text(double seconds);

/// "1 trial", "3 trials"
std::string counted(std::int64_t number, const char* what);

}  // namespace rehearse::apps
