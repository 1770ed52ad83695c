#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rehearse/campaign/results.hpp"

namespace rehearse::campaign {

enum class Verdict { pass, fail, undecided };
const char* to_text(Verdict verdict);

/// The result of one part of a claim.
struct PartResult {
  std::string measure;         // "solved by trial 5"
  std::string required;        // "rate ≥ 0.95"
  Index runs = 0;              // or pairs, that are used
  Index of = 0;                // that the claim is about
  std::optional<Index> count;  // solved, for claims of success
  double estimate = 0;         // NaN while there are no runs
  Interval interval;           // 95 %
  Verdict verdict = Verdict::undecided;
  std::string reason;  // why it is undecided
};

/// Passes if all parts do, fails if one does. parts[i] belongs to the planned claim's.
struct ClaimResult {
  Verdict verdict = Verdict::undecided;
  std::vector<PartResult> parts;
};

/// The result of every claim, with the runs so far.
std::vector<ClaimResult> judge(const Campaign& campaign);

}  // namespace rehearse::campaign
