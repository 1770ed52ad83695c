#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rehearse/core/options.hpp"

namespace rehearse::experiment {

inline constexpr double kMostSeed = 9007199254740992.0;  // 2^53: survives every file format

/// The end of a run; it may be changed during the run.
struct Until {
  Until(Index all, bool or_solved = false) : trials(all), solved(or_solved) {}  // NOLINT(google-explicit-constructor)

  Index trials;
  bool solved;  // the run ends earlier, with a trial that solves the task
};

/// The states by which the learner is told what an episode earned and whether it solved the task. Rows of trials.csv
/// are always by the noise-free ones, where the plant knows them.
enum class ToldBy { truth, measured };

/// The description of a run: everything that decides its results, and nothing else.
struct Spec {
  std::string scenario;
  std::string learner;
  std::string robot;  // checksum of the file that describes the scenario's robot; empty: it is built in
  std::string prior;  // a name, several as "a,b,c", "oracle" (the plant's own dynamics), or empty: the default
  Index trials = 10;
  bool until_solved = false;  // ends before, with a trial that solves the task
  Index seed = 1;
  std::string start;               // θ of the policy that it begins with, numbers with blanks between; empty: none
  ToldBy told_by = ToldBy::truth;  // measured: as a robot without other sensors would

  /// Key and value as text. A key is a field of the scenario, else one of the learner (`scenario.KEY` and
  /// `learner.KEY` say which), `told_by`, or a parameter's starting value, `prior.NAME` (`prior.PRIOR.NAME` in one of
  /// several).
  std::vector<std::pair<std::string, std::string>> options;

  /// The spec without its end, which may change during a run.
  Spec without_end() const {
    Spec spec = *this;
    spec.trials = 0;
    spec.until_solved = false;
    return spec;
  }

  /// True if the run ends with a trial. solved: that trial solves the task.
  bool ends_with(Index trial, bool solved) const { return trial >= trials || (until_solved && solved); }

  void fields(FieldVisitor& v) {
    v.integer("trials", trials, "trials on the plant; 0: none, trials come by `ask` and `tell`", between(0, 1e6));
    v.boolean("until_solved", until_solved, "end before, with a trial that solves the task");
    v.integer("seed", seed, "seed of all random numbers: the same one gives the same run", between(0, kMostSeed));
    v.text("start", start,
           "parameters of an initial policy: searches start from it, too; without a prior it is the first trial");
    settable_fields(v);
  }
  /// The fields that --set changes, too.
  void settable_fields(FieldVisitor& v) {
    v.choice("told_by", told_by, "states that rewards and success are computed from, for the learner: true or measured",
             {"truth", "measured"});
  }
};

/// Names of what --set changes of a run itself, not of its learner, scenario or priors.
std::vector<std::string> options_of_runs();

/// Help lines of options, by the names that a complete spec has for them.
using Comments = std::map<std::string, std::string>;

/// θ as the text of `Spec::start`, and back; empty: the text is not a list of numbers.
std::string start_text(const Vector& theta);
std::optional<Vector> start_of(const std::string& text);

/// "SCENARIO-LEARNER-PRIOR-SEED" of a complete spec, or "SCENARIO-LEARNER-PRIOR-VARIANT-SEED"; PRIOR is "none" for a
/// learner that takes none. It names a folder on every file system.
std::string run_name(const Spec& spec, const std::string& variant = "");

/// The folder of a run that is given none.
std::string default_folder(const Spec& spec);

/// An option as a file has it.
struct FileOption {
  std::string key, text;
  Index line = 0;
};

Spec with_options(Spec spec, const std::vector<FileOption>& options);

}  // namespace rehearse::experiment
