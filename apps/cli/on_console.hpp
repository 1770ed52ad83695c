#pragma once

#include <filesystem>
#include <functional>

#include "apps/cli/console.hpp"
#include "rehearse/experiment/run_options.hpp"
#include "rehearse/experiment/second_look.hpp"

namespace rehearse::apps {

/// Works on a run with signals caught and the console listening. Returns the exit code: that of a signal, with a line
/// on how to go on (`again`: the command line), where one came. Throws std::runtime_error with advice where the run
/// failed.
int on_console(const std::filesystem::path& folder, Index threads, Console& console, const std::string& again,
               const std::function<void(const experiment::RunOptions&)>& work);

/// Prints it.
void put_second_look(const experiment::SecondLook& look);

}  // namespace rehearse::apps
