#pragma once
// Exceptions of a run become failures with a cause. For the sources of this room.

#include <new>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/experiment/memory.hpp"
#include "rehearse/experiment/run_folder.hpp"
#include "rehearse/experiment/run_options.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::experiment {

/// The value of `step`; any failure but the user's stop says in which trial and who. outside: of the program, so that
/// it need not fail again.
template <class Step>
auto named_failure(Index trial, const char* who, Step step, bool outside = false) -> decltype(step()) {
  try {
    return step();
  } catch (const std::bad_alloc&) {
    throw;  // with the options that ask for so much
  } catch (const RunFailed&) {
    throw;  // it says what failed
  } catch (const system::Stopped&) {
    throw Interrupted{};
  } catch (const system::Unavailable& error) {
    throw RunFailed(fmt::format("trial {}: the {} failed: {}", trial, who, error.what()), true);
  } catch (const std::exception& error) {
    throw RunFailed(fmt::format("trial {}: the {} failed: {}", trial, who, error.what()), outside);
  }
}

/// The value of `run`, whose failures say what can be done about them; its folder keeps the last one.
template <class Run>
auto with_causes(const Catalogue& catalogue, const Spec& complete, const std::filesystem::path& folder, Run run)
    -> decltype(run()) {
  const auto kept = [&](const RunFailed& error) {
    RunFolder::keep_failure(folder, error.what());
    return error;
  };
  try {
    return run();
  } catch (const std::bad_alloc&) {
    throw kept(RunFailed(not_enough_memory(catalogue, complete), true));
  } catch (const RunFailed& error) {
    throw kept(error);
  } catch (const InvalidInput&) {
    throw;
  } catch (const std::runtime_error& error) {  // a file could not be written
    throw kept(RunFailed(error.what(), true));
  }
}

}  // namespace rehearse::experiment
