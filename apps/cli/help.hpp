#pragma once
// Texts of --help beside the options. {0}: the name of the program.

namespace rehearse::apps {

inline constexpr const char* kAbout = R"(Learn a robot's policy in a handful of trials.

A learner optimises a policy on a guess of the robot's dynamics (the prior), tries
it on the robot once, corrects its model from what happened, and repeats.)";

inline constexpr const char* kExample = R"(Example: swing up the pendubot in 10 trials, starting from a wrong simulator:
  {0} learn pendubot --learner gp-mi --prior misleading --out runs/demo
Then continue it to 15 trials:
  {0} resume runs/demo --trials 15
Do many runs and compare them:
  {0} campaign campaigns/pendubot-short.toml --out runs/short
See what happened, in a browser:
  {0} report runs/demo
Take the best policy along:
  {0} export runs/demo --out policy.h
All scenarios and learners:
  {0} list
A robot of your own:
  {0} new my_robot)";

inline constexpr const char* kListExample = R"(Examples:
  {0} list                         all scenarios and learners
  {0} list pendubot                a scenario with its options
  {0} list gp-mi --expert          a learner with all of its options
  {0} list --schema >robot.json    for an editor that completes robots' files)";

inline constexpr const char* kNewExample = R"(A robot of your own:
  {0} new my_robot                 writes my_robot.toml, a pendulum with comments
  {0} check my_robot.toml          after every change: what was understood
  {0} learn my_robot.toml --learner gp-mi

docs/own-robot.md describes the file.)";

inline constexpr const char* kResumeExample = R"(Examples:
  {0} resume runs/demo                what was interrupted
  {0} resume runs/demo --trials 15    five trials more, after ten)";

inline constexpr const char* kIdentifyExample = R"(Example:
  {0} identify my_robot.toml log1.csv log2.csv --held-out log3.csv --out runs/identified

docs/identify.md describes what it prints and writes.)";

inline constexpr const char* kReportExample = R"(Examples:
  {0} report runs/demo                          writes runs/demo/report.html
  {0} replay runs/demo --trial 3 --out 3.html   one motion alone

docs/report.md says how to read the page.)";

inline constexpr const char* kExportExample = R"(Examples:
  {0} export runs/demo --out policy.h              C99 without dependencies
  {0} export runs/demo --trial 3 --out policy.py   a module for NumPy

docs/export.md says how to call it.)";

inline constexpr const char* kEvaluateExample = R"(Examples:
  {0} evaluate runs/demo --episodes 100
  {0} evaluate runs/demo --seconds 10 --set measurement_noise=0.01
  {0} evaluate runs/demo --robustness)";

inline constexpr const char* kAskExample = R"(A robot that Rehearse does not drive:
  {0} learn my_robot.toml --learner gp-mi --trials 0 --out runs/robot
  {0} tell runs/robot old_log.csv        if there are any
  {0} ask runs/robot                     the policy to try
  {0} tell runs/robot episode.csv        what it did
  {0} status runs/robot)";

inline constexpr const char* kLearnExample = R"(Examples:
  {0} learn pendubot --learner gp-mi --prior misleading --trials 10 --seed 1
  {0} learn pendubot --learner gp-mi --set plant.b1=0.2 --set prior.l2=0.3
  {0} learn pendubot --learner gp-mi --preset as-published
  {0} learn my_robot.toml --learner gp-mi
  {0} learn runs/demo/spec.toml --out runs/again

The folder holds one row a trial in trials.csv, the trajectories, the model's predictions,
the policies, and spec.toml, which gives the same trials.csv when it is run again.
Ctrl-C stops the run; `{0} resume` continues it.)";

inline constexpr const char* kCampaignExample = R"(Example:
  {0} campaign campaigns/pendubot-short.toml --out runs/short

The same command continues what was interrupted. The folder holds the run folders in runs,
a row for every trial in campaign.csv, and statistics and claims in summary.json.
docs/campaigns.md describes the file.)";

}  // namespace rehearse::apps
