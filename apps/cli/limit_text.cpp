#include "apps/cli/limit_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rehearse::apps {

/// Three digits, since two make 1e+02 of 100.
std::string risk_text(const experiment::LimitRecord& limit, const char* interval) {
  if (!limit.predicted) return "";
  return fmt::format("{:.3g} % ({}{:.3g} to {:.3g})", 100 * *limit.predicted, interval, 100 * limit.interval.low,
                     100 * limit.interval.high);
}

std::string broken_text(const std::vector<experiment::LimitRecord>& limits) {
  std::vector<std::string> names;
  for (const experiment::LimitRecord& limit : limits)
    if (limit.broken) names.push_back(limit.limit);
  return names.empty() ? "" : fmt::format("broke {}", fmt::join(names, ", "));
}

}  // namespace rehearse::apps
