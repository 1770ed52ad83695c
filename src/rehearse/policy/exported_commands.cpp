#include "rehearse/policy/exported_commands.hpp"

#include <cmath>

#include <fmt/format.h>

#include "rehearse/policy/exported_text.hpp"

namespace rehearse::policy {
namespace {

/// Makes the lines for the command of one action.
class CommandLines {
 public:
  CommandLines(const Actuators::Line& line, Index action, const Dialect& dialect)
      : line_(line), dialect_(dialect), action_(dialect.action(action)) {}

  std::string make() {
    if (line_.passes < 1)
      assign(action_, fmt::format("{1} + {2} * ({0} - {1})", action_, last(), number(line_.passes)));
    if (std::isfinite(line_.max_step)) {
      const std::string step = number(line_.max_step);
      assign(action_, fmt::format(fmt::runtime(dialect_.limited), action_, fmt::format("{} - {}", last(), step),
                                  fmt::format("{} + {}", last(), step)));
    }
    if (line_.reached >= 0) {
      const std::string reached = dialect_.before(line_.reached), held = this->held();
      assign(dialect_.after(line_.reached), fmt::format("{0} + {1} * ({2} - {0})", held, number(line_.stays), reached));
    }
    for (Index k = line_.before - 1; k >= 0; --k) assign(dialect_.after(line_.first + k), sent(k));  // oldest first
    return lines_;
  }

 private:
  void assign(const std::string& to, const std::string& value) {
    lines_ += fmt::format("{}{} = {}{}\n", dialect_.indent, to, value, dialect_.end);
  }

  std::string last() const { return dialect_.before(line_.first); }

  /// The command so many steps ago.
  std::string sent(Index ago) const { return ago == 0 ? action_ : dialect_.before(line_.first + ago - 1); }

  /// The mean over the step of what arrives.
  std::string held() const {
    if (line_.further == 0) return sent(line_.delay);
    return fmt::format("({} * {} + {} * {})", number(1 - line_.further), sent(line_.delay), number(line_.further),
                       sent(line_.delay + 1));
  }

  const Actuators::Line& line_;
  const Dialect& dialect_;
  std::string action_, lines_;
};

}  // namespace

std::string command_lines(const Actuators& actuators, const Dialect& dialect) {
  std::string lines;
  for (std::size_t a = 0; a < actuators.lines().size(); ++a)
    lines += CommandLines(actuators.lines()[a], static_cast<Index>(a), dialect).make();
  return lines;
}

}  // namespace rehearse::policy
