#pragma once
// The processes that mpirun or srun started together: they work on one campaign.

#include <memory>
#include <string>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/ranks.hpp"

namespace rehearse::apps {

/// How this process was started, as the launcher's variables say; without a launcher it is the only one.
struct Launch {
  std::string by;  // "mpirun"
  int rank = 0;
  int size = 1;
};
Launch launch();

/// A process with --share works alone however it was started: the option says what its part of the work is.
Launch launch(int argc, char** argv);

/// The processes that this one works with.
struct ProcessGroup {
  std::unique_ptr<Ranks> ranks;  // null: it is alone, and MPI was not initialised
  int sharing = 1;               // how many processes, this one included, may use the same cores

  bool leads() const { return !ranks || ranks->rank() == 0; }

  /// Threads of this process; asked: 0 for its share of the cores.
  int threads(Index asked) const;
};

/// Throws InvalidInput if the processes that were started together cannot work together; `processes` is there all the
/// same, so that they end together: mpirun stops the others, and what they had to say, as soon as one ends badly.
void join(ProcessGroup& processes, const Launch& launch, int argc, char** argv);

}  // namespace rehearse::apps
