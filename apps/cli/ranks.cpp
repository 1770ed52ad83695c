#include "apps/cli/ranks.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/errors.hpp"
#ifdef REHEARSE_MPI
#include "rehearse/mpi/ranks.hpp"
#endif

namespace rehearse::apps {
namespace {

bool does_a_share(int argc, char** argv) {
  return std::any_of(argv, argv + argc, [](const std::string_view argument) {
    return argument == "--share" || argument.starts_with("--share=");
  });
}

int number_in(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : otherwise;
}

#ifdef REHEARSE_MPI

void check_arguments(Ranks& ranks, int argc, char** argv) {
  const std::string line = fmt::format("{}", fmt::join(argv + std::min(argc, 1), argv + argc, " "));
  const std::vector<std::string> lines = ranks.exchange("arguments", line);
  for (std::size_t i = 1; i < lines.size(); ++i)
    if (lines[i] != lines[0])
      throw InvalidInput(
          fmt::format("processes that are started together need the same arguments, but rank 0 has '{}' "
                      "and rank {} '{}'",
                      lines[0], i, lines[i]));
}

#endif

}  // namespace

// srun sets the last pair for every step; mpirun on Slurm starts its own helpers by srun, so its own come first.
Launch launch() {
  if (std::getenv("OMPI_COMM_WORLD_SIZE"))
    return {"mpirun", number_in("OMPI_COMM_WORLD_RANK", 0), number_in("OMPI_COMM_WORLD_SIZE", 1)};
  if (std::getenv("PMI_SIZE")) return {"mpirun or srun", number_in("PMI_RANK", 0), number_in("PMI_SIZE", 1)};
  return {"srun", number_in("SLURM_PROCID", 0), number_in("SLURM_STEP_NUM_TASKS", 1)};
}

Launch launch(int argc, char** argv) { return does_a_share(argc, argv) ? Launch{} : launch(); }

int ProcessGroup::threads(Index asked) const {
  if (asked > 0) return static_cast<int>(asked);
  return std::max(1, make_thread_evaluator(0)->concurrency() / sharing);
}

#ifdef REHEARSE_MPI

void join(ProcessGroup& processes, const Launch& launch, int argc, char** argv) {
  if (launch.size <= 1) return;
  processes.ranks = mpi::join();
  Ranks& ranks = *processes.ranks;
  if (ranks.size() != launch.size)
    throw InvalidInput(
        fmt::format("{} started this {} times, but Open MPI joins {} of them; start it with Open MPI's "
                    "mpirun, or srun --mpi=pmix",
                    launch.by, launch.size, ranks.size()));
  check_arguments(ranks, argc, argv);
  const std::string own = mpi::cores();
  const std::vector<std::string> cores = ranks.exchange("cores", own);
  processes.sharing = static_cast<int>(std::count(cores.begin(), cores.end(), own));
}

#else

void join(ProcessGroup&, const Launch& launch, int, char**) {
  if (launch.size <= 1) return;
  throw InvalidInput(
      fmt::format("{} started this {} times, but it was built without MPI (Open MPI was not found) and "
                  "they cannot work together; start it without {}",
                  launch.by, launch.size, launch.by));
}

#endif

}  // namespace rehearse::apps
