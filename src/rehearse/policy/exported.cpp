#include "rehearse/policy/exported.hpp"

#include <cctype>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::policy {

Exported make_exported(const Origin& origin, const Task& task, const Policy& policy, const Vector& theta,
                       const Answers& asked) {
  return with_theta({.origin = origin,
                     .states = task.states,
                     .actions = task.actions,
                     .actuators = task.actuators(),
                     .dt_s = task.dt_s,
                     .horizon = task.horizon,
                     .kind = policy.name(),
                     .theta = {},
                     .description = {},
                     .answers = asked},
                    policy, theta);
}

Exported with_theta(Exported exported, const Policy& policy, const Vector& theta) {
  exported.description = describe(policy, theta);
  exported.theta = theta;
  Answers& answers = exported.answers;
  const auto states = static_cast<Index>(exported.states.size());
  if (answers.states.cols() != states || answers.times_s.size() != answers.states.rows())
    throw InvalidInput(
        fmt::format("the states to ask the policy about are {} × {}, at {} times; must be n × {}, at n times",
                    answers.states.rows(), answers.states.cols(), answers.times_s.size(), states));
  answers.actions.resize(answers.states.rows(), policy.actions());
  const Matrix Theta = theta.transpose();
  for (Index i = 0; i < answers.states.rows(); ++i)
    policy.act(Theta, answers.states.middleRows(i, 1), answers.times_s(i), answers.actions.middleRows(i, 1));
  exported.actuators.command(answers.states, answers.actions);
  return exported;
}

bool is_exported(std::string_view text) { return text.substr(0, 300).find(kExportedMark) != std::string_view::npos; }

std::string identifier(const std::string& text) {
  std::string name;
  for (const unsigned char c : text) name += c < 0x80 && std::isalnum(c) != 0 ? static_cast<char>(c) : '_';
  return name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) != 0 ? "policy_" + name : name;
}

}  // namespace rehearse::policy
