#include "rehearse/campaign/claim_plan.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "rehearse/core/names.hpp"
#include "rehearse/files/toml_reader.hpp"

namespace rehearse::campaign {
namespace {

/// Finds what a claim names.
class ClaimPlanner {
 public:
  ClaimPlanner(const CampaignPlan& plan, const Claim& claim, files::FileViolations& violations)
      : plan_(plan), claim_(claim), violations_(violations), planned_{.claim = claim} {}

  PlannedClaim planned() {
    const std::vector<std::size_t> groups = claimed_groups();
    if (claim_.pooled && !groups.empty()) planned_.parts = {{groups, {}}};
    if (!claim_.pooled)
      for (std::size_t group : groups) planned_.parts.push_back({{group}, {}});
    if (claim_.comparison) find_opponents();
    check_counts();
    if (planned_.parts.empty()) planned_.parts.emplace_back();  // of a learner that is missing
    return std::move(planned_);
  }

 private:
  void wrong(const std::string& message) { violations_.add(claim_.line, message); }

  bool is_missing(const std::string& learner) {
    for (const MissingLearner& missing : plan_.missing)
      if (missing.name == learner) planned_.missing = missing.reason;
    return !planned_.missing.empty();
  }

  std::vector<std::size_t> claimed_groups() {
    std::vector<std::size_t> found;
    if (is_missing(claim_.learner)) return found;
    std::vector<std::string> priors, variants;  // of this learner
    for (std::size_t i = 0; i < plan_.groups.size(); ++i) {
      const CampaignGroup& group = plan_.groups[i];
      if (group.learner != claim_.learner) continue;
      priors.push_back(group.prior);
      variants.push_back(group.variant);
      const bool prior = claim_.priors.empty() || is_among(group.prior, claim_.priors);
      if (prior && (claim_.variants.empty() || is_among(group.variant, claim_.variants))) found.push_back(i);
    }
    const bool known = check_names("prior", claim_.priors, priors) & check_names("variant", claim_.variants, variants);
    if (found.empty() && known && !priors.empty())
      wrong("no runs have both one of these priors and one of these variants");
    return found;
  }

  bool check_names(const char* what, const std::vector<std::string>& named, const std::vector<std::string>& known) {
    bool all = true;
    for (const std::string& name : named)
      if (!is_among(name, known))
        all = false, wrong(fmt::format("learner {} has no {} '{}'", claim_.learner, what, name));
    return all;
  }

  void find_opponents() {
    if (claim_.comparison->learner && is_missing(*claim_.comparison->learner)) return;
    for (ClaimPart& part : planned_.parts)
      for (std::size_t group : part.groups)
        if (const auto opponent = opponent_of(group)) part.against.push_back(*opponent);
  }

  /// The group that differs in what the comparison names. A learner without priors or variants has but one, and one
  /// that lacks some of the options that vary is met with the others.
  std::optional<std::size_t> opponent_of(std::size_t index) {
    const CampaignGroup& group = plan_.groups[index];
    const ComparisonClaim& comparison = *claim_.comparison;
    const std::string learner = comparison.learner.value_or(group.learner),
                      prior = comparison.prior.value_or(group.prior),
                      variant = comparison.variant.value_or(group.variant);
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < plan_.groups.size(); ++i) {
      const CampaignGroup& other = plan_.groups[i];
      const bool same_prior = other.prior == prior || (other.prior.empty() && !comparison.prior);
      if (other.learner != learner || !same_prior) continue;
      if (other.variant == variant) {
        found = i;
        break;
      }
      if (!found && !comparison.variant && is_part(other, group)) found = i;
    }
    if (found == index) wrong("the claim compares runs with themselves");
    if (!found)
      wrong(fmt::format("there is nothing to compare with: no runs of learner {}, prior '{}', variant '{}'", learner,
                        prior, variant));
    return found;
  }

  static bool is_part(const CampaignGroup& other, const CampaignGroup& group) {
    return std::all_of(other.options.begin(), other.options.end(), [&](const auto& option) {
      return std::find(group.options.begin(), group.options.end(), option) != group.options.end();
    });
  }

  void check_counts() {
    if (!claim_.success) return;
    for (const ClaimPart& part : planned_.parts) {
      const auto runs = static_cast<Index>(part.groups.size() * plan_.seeds.size());
      if (claim_.success->at_least_runs.value_or(0) > runs)
        return wrong(
            fmt::format("at_least_runs = {}, but the claim is about {} runs", *claim_.success->at_least_runs, runs));
    }
  }

  const CampaignPlan& plan_;
  const Claim& claim_;
  files::FileViolations& violations_;
  PlannedClaim planned_;
};

}  // namespace

PlannedClaim plan_claim(const CampaignPlan& plan, const Claim& claim, files::FileViolations& violations) {
  return ClaimPlanner(plan, claim, violations).planned();
}

}  // namespace rehearse::campaign
