#include <filesystem>

#include <fmt/format.h>

#include "apps/cli/arguments.hpp"
#include "apps/cli/campaign_console.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/signals.hpp"
#include "rehearse/experiment/campaign_claims.hpp"
#include "rehearse/experiment/files.hpp"

namespace rehearse::apps {
namespace {

using experiment::Campaign, experiment::CampaignOptions, experiment::RunState;

bool a_claim_failed(const Campaign& campaign) {
  for (const experiment::ClaimResult& claim : experiment::judge(campaign))
    if (claim.verdict == experiment::Verdict::fail) return true;
  return false;
}

}  // namespace

int campaign(const experiment::Catalogue& catalogue, const CampaignArguments& arguments) {
  Violations violations;
  const Index threads = threads_of(arguments.threads, violations);
  violations.require(!arguments.out || !arguments.out->empty(), "--out names no folder");
  violations.throw_if_any();
  const std::string text = experiment::read_file(arguments.file);
  if (arguments.dry_run) {
    print_plan(experiment::plan_campaign(catalogue, text, arguments.file));
    return kSuccess;
  }
  const std::string folder = arguments.out.value_or("runs/" + std::filesystem::path(arguments.file).stem().string());

  CampaignConsole console(folder);
  catch_signals();
  const Campaign done = experiment::run_campaign(
      catalogue, text, arguments.file, folder,
      {.threads = static_cast<int>(threads), .listener = &console, .stop = [] { return caught_signal() != 0; }});
  if (done.count(RunState::unfinished) > 0) {
    console.clear_line();
    fmt::print(stderr, "rehearse: interrupted with {} of {} runs done; to continue, give the same command again\n",
               done.count(RunState::done), done.runs.size());
    return 128 + caught_signal();
  }
  console.finished(done);
  const bool failed = done.count(RunState::failed) > 0 || (arguments.check_claims && a_claim_failed(done));
  return failed ? kFailed : kSuccess;
}

}  // namespace rehearse::apps
