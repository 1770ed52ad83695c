#include "rehearse/study/log_model.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/statistics/columns.hpp"

namespace rehearse::study {
namespace {

constexpr double kStretchS = 1;
constexpr double kMostSteps = 1e12;  // more than a log has, and whole numbers can still be computed with

}  // namespace

Index steps_of(double time_s, const Task& task) {
  return static_cast<Index>(std::clamp(std::round(time_s / task.dt_s), 1.0, kMostSteps));
}

std::vector<Index> states_named(const std::string& names, const Task& task) {
  std::vector<Index> states;
  const std::vector<std::string> known = task.state_names();
  std::istringstream all(names);
  Violations violations;
  for (std::string name; std::getline(all, name, ',');) {
    const auto found = std::ranges::find(known, name);
    const Index state = found - known.begin();
    if (found == known.end())
      violations.add(fmt::format("zeros: there is no state '{}'{}", name, did_you_mean(name, known)));
    else if (std::ranges::find(states, state) != states.end())
      violations.add(fmt::format("zeros = {} has '{}' twice, must name each state once", names, name));
    else
      states.push_back(state);
  }
  violations.throw_if_any();
  return states;
}

ZeroProblem zero_problem(const prior::Prior& prior, const Task& task, const Options& options) {
  return {prior, states_named(options.zeros, task), options.zero_range, steps_of(options.fit_horizon_s, task)};
}

LogModel learn_logs(const std::vector<Episode>& logs, const Task& task, const prior::Prior& prior,
                    const Options& options, const Evaluator& evaluator) {
  LogModel model{.zeros = find_zeros(logs, zero_problem(prior, task, options), evaluator)};
  std::vector<Episode> right;
  for (std::size_t i = 0; i < logs.size(); ++i) {
    right.push_back(moved(logs[i], model.zeros.offsets.row(static_cast<Index>(i)).transpose()));
    model.all_rows += logs[i].steps();
  }
  model.data = spread_rows(right, options.rows, steps_of(kStretchS, task));
  model.learned = learned_beyond(model, task, prior, options, evaluator);
  return model;
}

identification::Learned learned_beyond(const LogModel& model, const Task& task, const prior::Prior& prior,
                                       const Options& options, const Evaluator& evaluator) {
  const auto learn = [&](const prior::Prior& of, const identification::Kind& kind) {
    const identification::LearningProblem problem{model.data, task.model_features(), task.kinematics(), &of,
                                                  {},         task.state_names()};
    return identification::learn(problem, kind, {{}, model.zeros.phi}, evaluator);
  };
  if (options.beyond == Beyond::gp_mi) return learn(prior, options.model);
  prior::Prior at_phi = prior;
  at_phi.space = prior.space.fixed_at(model.zeros.phi);
  identification::Learned learned;
  if (options.beyond == Beyond::nothing || options.beyond == Beyond::chosen)
    learned.model = std::make_shared<dynamics::SimulatorModel>(at_phi, model.zeros.phi);
  else
    learned = learn(at_phi, identification::FixedPrior{options.model.gp});
  for (const Index i : prior.space.of_kind(Parameter::Kind::discrete))
    learned.notes.push_back(fmt::format("{} is a choice, and stays {:g}: --set beyond=gp-mi chooses",
                                        prior.space[i].name, model.zeros.phi(i)));
  learned.state.phi = model.zeros.phi;
  learned.posterior = model.zeros.posterior;
  return learned;
}

PreparedLog prepare(const Episode& log, const LogModel& model, const Task& task, const prior::Prior& prior,
                    const Options& options, const Evaluator& evaluator) {
  const Vector none = Vector::Zero(log.states.cols());
  const Index first = steps_of(options.zero_s, task);
  if (states_named(options.zeros, task).empty()) return {log, none, none, 0};
  prior::Prior learned = prior;
  learned.space = prior.space.fixed_at(*model.learned.state.phi);
  const Zeros zeros = find_zeros({log.part(0, first)}, zero_problem(learned, task, options), evaluator);
  const Vector offset = zeros.offsets.row(0).transpose();
  return {moved(log, offset), offset, zeros.deviations.row(0).transpose(), first};
}

bool moves(const LogModel& model) {
  constexpr double kRounding = 1e-9;  // of the mean of equal numbers, beside them
  const Matrix& states = model.data.states;
  const Vector spread = statistics::column_root_mean_squares(states.rowwise() - states.colwise().mean());
  const Vector least = statistics::column_root_mean_squares(model.data.changes)
                           .cwiseMax(kRounding * statistics::column_root_mean_squares(states));
  return (least.array() < spread.array()).any();
}

std::vector<Interval> intervals_of(const LogModel& model) {
  const auto& posterior = model.learned.posterior;
  return posterior && moves(model) ? posterior->intervals() : std::vector<Interval>{};
}

}  // namespace rehearse::study
