#include "rehearse/cli/cli.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "apps/catalogue.hpp"
#include "apps/cli/additions.hpp"
#include "apps/cli/commands.hpp"
#include "apps/cli/complain.hpp"
#include "apps/cli/parser.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/names.hpp"
#include "rehearse/core/processor.hpp"

namespace rehearse::apps {
namespace {

int run(const experiment::Catalogue& catalogue, const Typed& typed, const ProcessGroup& processes, const char* share) {
  const std::string& command = typed.command;
  if (command == "campaign") return campaign(catalogue, typed.campaign, processes);
  if (processes.ranks && is_among(command, std::vector<std::string>{"learn", "resume", "ask", "tell"}))
    throw InvalidInput("one run is the work of one process, which takes --threads; several processes share a campaign");
  if (command == "learn") return learn(catalogue, typed.learn);
  if (command == "resume") return resume(catalogue, typed.resume);
  if (command == "ask") return ask(catalogue, typed.ask);
  if (command == "tell") return tell(catalogue, typed.tell);
  if (!processes.leads()) return kSuccess;
  if (command == "status") return status(catalogue, typed.status);
  if (command == "list") return list(catalogue, typed.list);
  if (command == "new") return make_new(catalogue, typed.make_new);
  if (command == "check") return check(catalogue, typed.check, share);
  if (command == "evaluate") return evaluate(catalogue, typed.evaluate);
  if (command == "export") return export_policy(to_look(catalogue), typed.export_policy);
  if (command == "identify") return identify(catalogue, typed.identify);
  if (command == "report") return report(to_look(catalogue), typed.report, share);
  return replay(typed.replay, share);
}

/// Opens standard streams that are closed: the next files would take their place, and get what is printed.
void keep_standard_descriptors() {
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
      (void)::open("/dev/null", stream == STDIN_FILENO ? O_RDONLY : O_WRONLY);
}

/// The end of the program.
struct End {
  int code = kSuccess;
  std::string message;
};

template <class Command>
End end_of(Command command) {
  try {
    return {command(), ""};
  } catch (const InvalidInput& error) {
    return {kWrongInput, error.what()};
  } catch (const std::filesystem::filesystem_error& error) {
    return {kWrongInput, fmt::format("cannot use {}: {}", error.path1().string(), error.code().message())};
  } catch (const std::bad_alloc&) {
    return {kFailed, "there is not enough memory"};
  } catch (const std::exception& error) {
    return {kFailed, error.what()};
  }
}

/// The end of a program whose output is written: a full disk is a failure.
End after_output(End end) {
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.flush().good();
  if (!written && end.code == kSuccess) return {kFailed, "cannot write to standard output"};
  return end;
}

/// Waits for the other ranks; what went wrong on one of them alone is said, too.
End end_with(Ranks& ranks, End end) {
  for (const Ranks::End& other : ranks.leave(end.code, end.message))
    if (end.message.empty() && !other.message.empty())
      end = {other.code, fmt::format("rank {} failed: {}", other.rank, other.message)};
  return end;
}

}  // namespace
}  // namespace rehearse::apps

int rehearse::cli(int argc, char** argv, const std::vector<RobotMaker>& robots,
                  const std::vector<LearnerFamily>& learners, const char* share) {
  using namespace rehearse::apps;
  keep_standard_descriptors();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of its write
  const Launch started = launch(argc, argv);
  ProcessGroup processes;
  End end = end_of([&]() -> int {
    require_processor();
    join(processes, started, argc, argv);
    const std::optional<Typed> typed = parse(argc, argv, !processes.leads());
    return typed ? run(with_additions(catalogue(), robots, learners), *typed, processes, share) : kSuccess;
  });
  end = after_output(std::move(end));
  if (processes.ranks) end = end_with(*processes.ranks, end);
  if (started.rank == 0) complain(end.message);
  return end.code;
}
