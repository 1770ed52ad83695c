#include <filesystem>

#include <fmt/format.h>

#include "apps/cli/arguments.hpp"
#include "apps/cli/cache.hpp"
#include "apps/cli/campaign_console.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/complain.hpp"
#include "apps/cli/signals.hpp"
#include "rehearse/campaign/claims.hpp"
#include "rehearse/campaign/planner.hpp"
#include "rehearse/campaign/robot_of.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::apps {
namespace {

using campaign::Campaign, campaign::CampaignOptions, campaign::RunState;

bool a_claim_failed(const Campaign& campaign) {
  for (const campaign::ClaimResult& claim : campaign::judge(campaign))
    if (claim.verdict == campaign::Verdict::fail) return true;
  return false;
}

campaign::Share share_of(const std::optional<std::string>& text, Violations& violations) {
  if (!text) return {};
  const auto share = campaign::read_share(*text);
  violations.require(share.has_value(), fmt::format("--share = {}, must be K/N with K from 1 to N", *text));
  return share.value_or(campaign::Share());
}

/// The words for runs that do not stop by themselves; with ranks, mpirun ends those that do not.
std::function<std::string()> last_words(const ProcessGroup& processes) {
  if (processes.ranks) return nullptr;
  return [] { return "interrupted; to continue, give the same command again"; };
}

void say_unfinished(const Campaign& campaign) {
  complain(fmt::format("interrupted with {} of {} runs done; to continue, give the same command again",
                       campaign.count(RunState::done), campaign.runs.size()));
}

}  // namespace

int campaign(const experiment::Catalogue& built_in, const CampaignArguments& arguments, const ProcessGroup& processes) {
  Violations violations;
  const Index threads = threads_of(arguments.threads, violations);
  const campaign::Share share = share_of(arguments.share, violations);
  violations.require(!arguments.out || !arguments.out->empty(), "--out names no folder");
  violations.require(share.of == 1 || !arguments.check_claims, "--check-claims needs all runs, --share does some");
  violations.throw_if_any();
  const std::string text = files::read_file(arguments.file, files::Links::follow);
  const experiment::Catalogue catalogue = campaign::with_robot_of(built_in, text, arguments.file);
  if (arguments.dry_run) {
    const campaign::CampaignPlan plan = campaign::plan_campaign(catalogue, text, arguments.file);
    if (processes.leads()) print_plan(plan);
    return kSuccess;
  }
  const std::string named = arguments.out.value_or("runs/" + std::filesystem::path(arguments.file).stem().string());
  const std::string folder = files::without_slash(named).string();

  CampaignConsole console(folder, share);
  const auto run = [&] {
    const SignalWatch watch(last_words(processes));
    return campaign::run_campaign(catalogue, text, arguments.file, folder,
                                  {.threads = processes.threads(threads),
                                   .listener = processes.leads() ? &console : nullptr,
                                   .stop = [] { return caught_signal() != 0; },
                                   .share = share,
                                   .cache = cache_folder,
                                   .ranks = processes.ranks.get()});
  };
  const Campaign done = run();
  if (!processes.leads()) return kSuccess;
  if (done.count(RunState::unfinished) > 0) {
    console.clear_line();
    say_unfinished(done);
    return exit_code_of_signal();
  }
  console.finished(done);
  const bool failed = done.count(RunState::failed) > 0 || (arguments.check_claims && a_claim_failed(done));
  return failed ? kFailed : kSuccess;
}

}  // namespace rehearse::apps
