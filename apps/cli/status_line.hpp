#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace rehearse::apps {

/// Standard output with a last line that is rewritten as work goes on, where it is a terminal.
class StatusLine {
 public:
  StatusLine();

  /// A line that stays.
  void print(const std::string& line);

  /// True if `show` would draw: on a terminal, at most ten times a second.
  bool is_due() const;
  void show(const std::string& line);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_;
  bool shown_ = false;
  Clock::time_point last_;
};

/// "45 s", "12 min", "3.1 h"
std::string duration_text(double seconds);

/// "1 trial", "3 trials"
std::string counted(std::int64_t number, const char* what);

}  // namespace rehearse::apps
