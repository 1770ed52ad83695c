#pragma once

#include <memory>
#include <string>

#include "rehearse/core/options.hpp"
#include "rehearse/learners/learner.hpp"
#include "rehearse/qd/archive_bytes.hpp"
#include "rehearse/qd/map_elites.hpp"

namespace rehearse::learners::ite {

/// Options of the archive of policies.
struct IlluminationOptions {
  std::string file;  // of an archive that was made before and is taken as it is, {seed} in it the run's seed; empty:
                     // one is made
  enum class Kind { cvt, grid };
  Kind kind = Kind::cvt;
  Index niches = 10000;        // of the tessellation (Vassiliades 2018)
  Index bins = 5;              // of the grid, for each descriptor (Cully 2015)
  Index evaluations = 200000;  // rollouts in the prior, rounded up to a generation
  double box = 5;              // θ in [−box, box] unless the policy has its own; as the other learners
  qd::MapElitesOptions search;
  void fields(FieldVisitor& v);
};

/// The archive of policies by MAP-Elites, each judged by one rollout in the prior as it is given, from the mean start
/// and without noise: performance is the return, the descriptor the task's. Comes from the setting's store where that
/// has it, after some elites were tried again; goes on there after an interruption. Depends on the setting (but its
/// evaluator and its store), the options and their file alone. Throws InvalidInput if nothing could be kept, or the
/// file is no archive of such policies.
std::shared_ptr<const qd::Search> illuminate(const Setting& setting, const IlluminationOptions& options);

/// The options for a run of this seed, which their file may name.
IlluminationOptions for_seed(IlluminationOptions options, std::uint64_t seed);

/// Violations, a line each: what the task lacks, and options or a file that do not fit it or the policy. A file that
/// names the seed is checked once that is known.
std::vector<std::string> violations(const IlluminationOptions& options, const Task& task, const policy::Policy& policy);

}  // namespace rehearse::learners::ite
