#include "rehearse/study/warnings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/identification/identifiability.hpp"

namespace rehearse::study {
namespace {

/// True if the intervals of a parameter in all models from logs that move have a value in common.
bool agree(const std::vector<LogModel>& models, std::size_t continuous) {
  Interval common{-kInf, kInf};
  for (const LogModel& model : models) {
    const std::vector<Interval> intervals = intervals_of(model);
    if (intervals.empty()) continue;
    common.low = std::max(common.low, intervals[continuous].low);
    common.high = std::min(common.high, intervals[continuous].high);
  }
  return common.low <= common.high;
}

/// The bound at which a parameter that is not there would predict best: errors are large, and tell little. Then the
/// bound may be the reason.
std::optional<double> best_at_a_bound(const Zeros& zeros, const Parameter& parameter, Index i) {
  const auto end = identification::end_at(parameter, zeros.closest_phi(i));
  return end && !identification::end_at(parameter, zeros.phi(i)) ? end : std::nullopt;
}

}  // namespace

std::vector<std::string> parameter_warnings(const Study& study, const Problem& problem) {
  const ParameterSpace& space = problem.prior.space;
  if (!space.has_tunable()) return {};
  if (!moves(study.model)) return {"nothing moves but by errors of measurement, which the parameters follow"};
  std::vector<std::string> lines;
  const std::vector<Index> continuous = space.of_kind(Parameter::Kind::continuous);
  for (std::size_t c = 0; c < continuous.size(); ++c)
    if (!agree(study.without, c))
      lines.push_back(fmt::format("{}: the intervals without one log do not overlap", space[continuous[c]].name));
  if (study.model.learned.posterior)
    for (std::string& line : identification::identifiability_warnings(*study.model.learned.posterior))
      lines.push_back(std::move(line));
  for (const Index i : continuous)
    if (const auto end = best_at_a_bound(study.model.zeros, space[i], i))
      lines.push_back(fmt::format("{} would predict best at its bound, {:.3g}: a better value may lie beyond",
                                  space[i].name, *end));
  return lines;
}

std::vector<std::string> log_warnings(const Study& study, const Task& task) {
  std::vector<std::string> lines;
  for (const Hint& hint : study.hints) lines.push_back(line_of(hint, task));
  if (!study.odd_log.empty()) lines.push_back(study.odd_log);
  return lines;
}

}  // namespace rehearse::study
