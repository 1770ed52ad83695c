#pragma once
// The commands, each with its arguments as they were typed. They return the exit code; wrong input throws InvalidInput.

#include <optional>
#include <string>
#include <vector>

#include "apps/cli/ranks.hpp"
#include "rehearse/experiment/catalogue.hpp"

namespace rehearse::apps {

enum ExitCode { kSuccess = 0, kFailed = 1, kWrongInput = 2 };  // and 128 + signal when interrupted

struct ListArguments {
  std::optional<std::string> name;  // of a scenario or a learner, or a robot's file
  bool json = false;
  bool options = false;
  bool expert = false;
  bool schema = false;
};

struct CheckArguments {
  std::string robot;               // a file, or the name of a built-in one
  std::optional<std::string> out;  // the page with its motion
  bool no_plant = false;
};

struct NewArguments {
  std::string name;  // of a robot
};

struct LearnArguments {
  std::string scenario;  // a name, a robot's file, or a spec.toml
  std::optional<std::string> learner, prior, preset, policy, trials, seed, threads, out;
  bool until_solved = false;
  std::vector<std::string> set;
};

struct ResumeArguments {
  std::string folder;
  std::optional<std::string> trials, threads;
};

struct AskArguments {
  std::string folder;
  std::optional<std::string> threads;
};

struct TellArguments {
  std::string folder;
  std::vector<std::string> files;
  std::optional<std::string> stopped, threads;
  bool no_fault = false, undo = false;
};

struct StatusArguments {
  std::string folder;
};

struct CampaignArguments {
  std::string file;
  std::optional<std::string> threads, out, share;
  bool check_claims = false;
  bool dry_run = false;
};

struct IdentifyArguments {
  std::string robot;  // a scenario's name or a robot's file
  std::vector<std::string> logs, held_out, set;
  std::optional<std::string> prior, threads, out;
};

struct ReportArguments {
  std::string folder;
  std::optional<std::string> out;
};

struct ReplayArguments {
  std::string folder;
  std::optional<std::string> trial, out;
  std::string headline;  // over the page instead of learner and robot; not to be typed
};

struct ExportArguments {
  std::string folder;
  std::optional<std::string> trial;
  std::string out;
};

struct EvaluateArguments {
  std::string folder;
  std::optional<std::string> trial, policy, episodes, seconds, seed, threads, out;
  bool robustness = false;
  std::vector<std::string> set;
};

// With processes, every process calls the same command; only the first prints.

/// The JSON that `list NAME --json` prints: an entry with its options. name: of a learner, a scenario or `identify`, or
/// a robot's file. Throws InvalidInput if there is none.
std::string entry_json(const experiment::Catalogue& catalogue, const std::string& name);

int list(const experiment::Catalogue& catalogue, const ListArguments& arguments);
int check(const experiment::Catalogue& catalogue, const CheckArguments& arguments, const std::string& share);
int make_new(const experiment::Catalogue& catalogue, const NewArguments& arguments);
int learn(const experiment::Catalogue& catalogue, const LearnArguments& arguments);
int resume(const experiment::Catalogue& catalogue, const ResumeArguments& arguments);
int ask(const experiment::Catalogue& catalogue, const AskArguments& arguments);
int tell(const experiment::Catalogue& catalogue, const TellArguments& arguments);
int status(const experiment::Catalogue& catalogue, const StatusArguments& arguments);
int identify(const experiment::Catalogue& catalogue, const IdentifyArguments& arguments);
int campaign(const experiment::Catalogue& catalogue, const CampaignArguments& arguments, const ProcessGroup& processes);

int evaluate(const experiment::Catalogue& catalogue, const EvaluateArguments& arguments);
int export_policy(const experiment::Catalogue& catalogue, const ExportArguments& arguments);

/// share: the folder of the page, where it is not beside the program.
int report(const experiment::Catalogue& catalogue, const ReportArguments& arguments, const std::string& share);
int replay(const ReplayArguments& arguments, const std::string& share);

}  // namespace rehearse::apps
