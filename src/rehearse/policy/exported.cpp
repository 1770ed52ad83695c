#include "rehearse/policy/exported.hpp"

#include <cctype>

namespace rehearse::policy {

Exported make_exported(const Origin& origin, const Task& task, const Policy& policy, const Vector& theta,
                       const Answers& asked) {
  Exported exported{.origin = origin,
                    .states = task.states,
                    .actions = task.actions,
                    .actuators = task.actuators(),
                    .dt_s = task.dt_s,
                    .kind = policy.name(),
                    .theta = theta,
                    .description = describe(policy, theta),
                    .answers = asked};
  exported.answers.actions.resize(asked.states.rows(), policy.actions());
  const Matrix Theta = theta.transpose();
  for (Index i = 0; i < asked.states.rows(); ++i)
    policy.act(Theta, asked.states.middleRows(i, 1), asked.times_s(i), exported.answers.actions.middleRows(i, 1));
  exported.actuators.command(asked.states, exported.answers.actions);
  return exported;
}

bool is_exported(std::string_view text) { return text.substr(0, 300).find(kExportedMark) != std::string_view::npos; }

std::string identifier(const std::string& text) {
  std::string name;
  for (const unsigned char c : text) name += c < 0x80 && std::isalnum(c) != 0 ? static_cast<char>(c) : '_';
  return name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) != 0 ? "policy_" + name : name;
}

}  // namespace rehearse::policy
