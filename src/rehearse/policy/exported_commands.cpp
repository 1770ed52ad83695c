#include "rehearse/policy/exported_commands.hpp"

#include <cmath>

#include <fmt/format.h>

#include "rehearse/policy/exported_text.hpp"

namespace rehearse::policy {
namespace {

/// Makes the lines for the command of one action.
class CommandLines {
 public:
  CommandLines(const Actuators::Channel& channel, Index action, const Dialect& dialect)
      : channel_(channel), dialect_(dialect), action_(dialect.action(action)) {}

  std::string make() {
    if (channel_.filter_gain < 1)
      assign(action_, fmt::format("{1} + {2} * ({0} - {1})", action_, last(), number(channel_.filter_gain)));
    if (std::isfinite(channel_.max_change)) {
      const std::string step = number(channel_.max_change);
      assign(action_, fmt::format(fmt::runtime(dialect_.limited), action_, fmt::format("{} - {}", last(), step),
                                  fmt::format("{} + {}", last(), step)));
    }
    if (channel_.reached_state >= 0) {
      const std::string reached = dialect_.before(channel_.reached_state), held = this->held();
      assign(dialect_.after(channel_.reached_state),
             fmt::format("{0} + {1} * ({2} - {0})", held, number(channel_.lag_decay), reached));
    }
    for (Index k = channel_.kept - 1; k >= 0; --k)
      assign(dialect_.after(channel_.last_command + k), sent(k));  // oldest first
    return lines_;
  }

 private:
  void assign(const std::string& to, const std::string& value) {
    lines_ += fmt::format("{}{} = {}{}\n", dialect_.indent, to, value, dialect_.end);
  }

  std::string last() const { return dialect_.before(channel_.last_command); }

  /// The command so many steps ago.
  std::string sent(Index ago) const { return ago == 0 ? action_ : dialect_.before(channel_.last_command + ago - 1); }

  /// The mean over the step of what arrives.
  std::string held() const {
    if (channel_.delay_fraction == 0) return sent(channel_.delay_steps);
    return fmt::format("({} * {} + {} * {})", number(1 - channel_.delay_fraction), sent(channel_.delay_steps),
                       number(channel_.delay_fraction), sent(channel_.delay_steps + 1));
  }

  const Actuators::Channel& channel_;
  const Dialect& dialect_;
  std::string action_, lines_;
};

}  // namespace

std::string command_lines(const Actuators& actuators, const Dialect& dialect) {
  std::string lines;
  for (std::size_t a = 0; a < actuators.channels().size(); ++a)
    lines += CommandLines(actuators.channels()[a], static_cast<Index>(a), dialect).make();
  return lines;
}

}  // namespace rehearse::policy
