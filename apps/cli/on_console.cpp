#include "apps/cli/on_console.hpp"

#include <fmt/format.h>

#include "apps/cli/cache.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/complain.hpp"
#include "apps/cli/signals.hpp"
#include "rehearse/experiment/kept_robot.hpp"

namespace rehearse::apps {
namespace {

std::string advice_after(const experiment::RunFailed& error, const std::filesystem::path& folder,
                         const std::string& again) {
  if (!std::filesystem::exists(folder)) return "nothing was begun; once the cause is gone, the same command begins";
  if (error.resume_may_help()) {
    const std::filesystem::path copies = folder / experiment::kRobotFolder;
    return fmt::format("what was done is kept; once the cause is gone: {}{}", again,
                       std::filesystem::exists(copies)
                           ? fmt::format("\nthe run keeps the robot's files as they were, in {}: where the cause is in "
                                         "one of them, mend it and learn into another folder",
                                         copies.string())
                           : "");
  }
  return fmt::format(
      "what was done is kept in {}; resumed, it would come to the same: learn with other options or "
      "another seed",
      folder.string());
}

std::string interrupted(const Console& console, const std::filesystem::path& folder, const std::string& again) {
  if (!std::filesystem::exists(folder)) return "interrupted before anything was done";
  return fmt::format("interrupted after {}; to continue: {}", counted(console.trials_done(), "trial"), again);
}

}  // namespace

int on_console(const std::filesystem::path& folder, Index threads, Console& console, const std::string& again,
               const std::function<void(const experiment::RunOptions&)>& work) {
  const experiment::RunOptions options{.evaluator = make_thread_evaluator(static_cast<int>(threads)),
                                       .listener = &console,
                                       .stop =
                                           [&] {
                                             console.look();
                                             return caught_signal() != 0;
                                           },
                                       .cache = cache_folder};
  try {
    const SignalWatch watch([&] { return interrupted(console, folder, again); });
    work(options);
    return kSuccess;
  } catch (const Interrupted&) {
    console.interrupted();
    complain(interrupted(console, folder, again));
    return exit_code_of_signal();
  } catch (const experiment::RunFailed& error) {
    console.clear_line();
    throw std::runtime_error(fmt::format("{}\n{}", error.what(), advice_after(error, folder, again)));
  }
}

void put_second_look(const experiment::SecondLook& look) {
  for (const std::string& line : look.readings) put("{}\n", line);
  if (!look.read_on.empty()) put("{}\n", look.read_on);
}

}  // namespace rehearse::apps
