#include "apps/cli/signals.hpp"

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>

#include <fmt/format.h>
#include <semaphore.h>
#include <unistd.h>

#include "apps/cli/complain.hpp"
#include "apps/cli/program.hpp"
#include "rehearse/files/temporary_folder.hpp"
#include "rehearse/system/process.hpp"

namespace rehearse::apps {
namespace {

constexpr auto kGrace = std::chrono::seconds(1);

std::atomic<int> remembered = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a handler of signals writes it");
sem_t came;  // posted by the first signal, and by the end of the watch

/// The second signal: programs that we started have no terminal's signals, and no destructor ends them now.
void end_at_once(int signal) {
  system::kill_programs();
  std::signal(signal, SIG_DFL);
  ::raise(signal);
}

void remember(int signal) {
  remembered = signal;
  for (const int number : {SIGINT, SIGTERM}) std::signal(number, end_at_once);
  sem_post(&came);
}

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = remember;
  for (const int number : {SIGINT, SIGTERM}) ::sigaction(number, &action, nullptr);
}

/// Prints a line; on a terminal in place of the one that is being rewritten.
void say(const std::string& line) {
  const std::string text =
      fmt::format("{}{}: {}\n", ::isatty(STDERR_FILENO) == 1 ? "\r\033[K" : "", program_name(), printable(line));
  put_error(text);
}

}  // namespace

SignalWatch::SignalWatch(std::function<std::string()> last_words) : last_words_(std::move(last_words)) {
  sem_init(&came, 0, 0);
  catch_signals();
  thread_ = std::thread([this] { watch(); });
}

SignalWatch::~SignalWatch() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  over_changed_.notify_all();
  sem_post(&came);
  thread_.join();
}

void SignalWatch::watch() {
  while (sem_wait(&came) != 0 && errno == EINTR) {
  }
  std::unique_lock lock(mutex_);
  if (remembered == 0 || !last_words_) return;
  say("stopping; again to end at once");
  if (over_changed_.wait_for(lock, kGrace, [this] { return over_; })) return;
  say(last_words_());
  system::kill_programs();
  files::remove_temporary_folders();  // of copies for these programs
  ::_exit(exit_code_of_signal());
}

int caught_signal() { return remembered; }

std::shared_ptr<const Evaluator> evaluator_until_signal(int threads) {
  return make_stoppable(make_thread_evaluator(threads), [] { return caught_signal() != 0; });
}

int exit_code_of_signal() {
  const int signal = caught_signal();
  return 128 + (signal != 0 ? signal : SIGTERM);
}

}  // namespace rehearse::apps
