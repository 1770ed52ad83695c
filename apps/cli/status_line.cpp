#include "apps/cli/status_line.hpp"

#include <cstdio>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "apps/cli/complain.hpp"
#include "apps/cli/ranks.hpp"
#include "rehearse/core/text_table.hpp"

namespace rehearse::apps {
namespace {

std::size_t line_width() {
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col - 1u : 79u;
}

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 99.5) return fmt::format("{:.0f} s", seconds);
  if (seconds < 99.5 * 60) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

std::string counted(std::int64_t number, const char* what) {
  return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s");
}

// Ranks say nothing: mpirun shows rank 0 a terminal even where its own output goes to a file.
StatusLine::StatusLine(std::chrono::milliseconds silence)
    : terminal_(::isatty(STDOUT_FILENO) == 1),
      alone_(launch().size == 1),
      silence_(terminal_ ? std::chrono::milliseconds(100) : silence) {}

void StatusLine::print(const std::string& line) {
  clear();
  put("{}\n", line);
  std::fflush(stdout);
  last_ = Clock::now();
}

bool StatusLine::is_due() const { return alone_ && Clock::now() - last_ >= silence_; }

void StatusLine::show(const std::string& line) {
  if (!is_due()) return;
  last_ = Clock::now();
  if (!terminal_) return put_error(printable(line) + "\n");
  fmt::print("\r\033[K{}", first_characters(printable(line), line_width()));
  std::fflush(stdout);
  shown_ = true;
}

void StatusLine::clear() {
  if (shown_) fmt::print("\r\033[K");
  std::fflush(stdout);
  shown_ = false;
}

}  // namespace rehearse::apps
