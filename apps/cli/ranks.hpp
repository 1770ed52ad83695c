#pragma once
// The processes that mpirun or srun started together: they work on one campaign.

#include <memory>
#include <string>

#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/ranks.hpp"

namespace rehearse::apps {

/// The way this process was started, from the launcher's environment variables; without a launcher it is the only one.
struct Launch {
  std::string by;  // "mpirun"
  int rank = 0;
  int size = 1;
};
Launch launch();

/// The launch of this process. With --share a process works alone, however it was started.
Launch launch(int argc, char** argv);

/// The processes that this one works with.
struct ProcessGroup {
  std::unique_ptr<Ranks> ranks;  // null: it is alone, and MPI was not initialised
  int sharing = 1;               // how many processes, this one included, may use the same cores

  bool leads() const { return !ranks || ranks->rank() == 0; }

  /// The threads of this process. asked: the number wanted; 0: its share of the cores.
  int threads(Index asked) const;
};

/// Throws InvalidInput if the processes that were started together cannot work together; `processes` is set all the
/// same, so that they end together: mpirun stops the others, and their output, as soon as one fails.
void join(ProcessGroup& processes, const Launch& launch, int argc, char** argv);

}  // namespace rehearse::apps
