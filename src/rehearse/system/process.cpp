#include "rehearse/system/process.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rehearse::system {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kLastWords = 2000;           // bytes of standard error that are kept
constexpr std::size_t kPipe = 1 << 20;             // bytes: a batch goes through without the two waiting for each other
constexpr double kForever = 1e9;                   // s
constexpr std::chrono::milliseconds kGrace{1000};  // for a program to end by itself once its input has ended

/// The programs that run, for kill_programs.
struct Place {
  std::atomic<pid_t> process{0};  // 0: the place is free
  std::atomic<int> input{-1};
};
std::array<Place, 1024> running;
std::atomic<bool> all_end = false;                       // kill_programs was called
static_assert(std::atomic<pid_t>::is_always_lock_free);  // handlers of signals read it

void note_running(pid_t process, int input) {
  for (Place& place : running)
    if (pid_t free = 0; place.process.compare_exchange_strong(free, process)) return place.input.store(input);
}

void note_ended(pid_t process) {
  for (Place& place : running) {
    if (place.process.load() != process) continue;
    place.input.store(-1);
    return place.process.store(0);
  }
}

/// True while a child runs. One that ended keeps its number until it is waited for, so its group can still be killed.
bool runs(pid_t process) noexcept {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == 0;
}

[[noreturn]] void fail(int error, const std::string& what) {
  throw std::system_error(error, std::generic_category(), what);
}

void close_all(std::initializer_list<int> files) {
  for (const int file : files)
    if (file >= 0) close(file);
}

/// Both ends of its standard streams. Its input is a socket: writing to a pipe without a reader raises a signal.
struct Streams {
  std::array<int, 2> input{-1, -1}, output{-1, -1}, error{-1, -1};  // ours, its own

  Streams() {
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, input.data()) != 0 || !pipe_of(output) || !pipe_of(error)) {
      const int why = errno;
      close_all({input[0], input[1], output[0], output[1], error[0], error[1]});
      fail(why, "no pipe can be made for a program");
    }
    for (const int ours : {input[0], output[0], error[0]}) fcntl(ours, F_SETFL, fcntl(ours, F_GETFL) | O_NONBLOCK);
    const int size = kPipe;
    setsockopt(input[0], SOL_SOCKET, SO_SNDBUF, &size, sizeof size);
    fcntl(output[0], F_SETPIPE_SZ, size);
  }

 private:
  static bool pipe_of(std::array<int, 2>& ends) { return pipe2(ends.data(), O_CLOEXEC) == 0; }
};

/// The attributes of a new process: streams, folder, signals, a group of its own.
class Spawning {
 public:
  Spawning(const Streams& streams, const std::string& folder) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, streams.input[1], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, streams.output[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, streams.error[1], STDERR_FILENO);
    if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    posix_spawnattr_setpgroup(&attributes_, 0);  // the terminal's Ctrl-C is for us
    sigset_t signals;
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
  }
  ~Spawning() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  Spawning(const Spawning&) = delete;
  Spawning& operator=(const Spawning&) = delete;

  int spawn(const std::vector<std::string>& command, pid_t& process) const {
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    return posix_spawnp(&process, arguments.front(), &actions_, &attributes_, arguments.data(), environ);
  }

 private:
  posix_spawn_file_actions_t actions_;
  posix_spawnattr_t attributes_;
};

/// Bytes read, 0 at the end of the stream, −1 where there are none now.
ssize_t read_some(int file, std::array<char, 1 << 16>& buffer) {
  for (;;) {
    const ssize_t n = read(file, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && errno != EAGAIN) return 0;
    return n;
  }
}

}  // namespace

Process::Process(const std::vector<std::string>& command, const std::filesystem::path& folder) {
  const Streams streams;
  const int failed = Spawning(streams, folder.string()).spawn(command, process_);
  close_all({streams.input[1], streams.output[1], streams.error[1]});
  input_ = streams.input[0], output_ = streams.output[0], error_ = streams.error[0];
  if (failed == 0) {
    note_running(process_, input_);
    return;
  }
  close_all({input_, output_, error_});
  fail(failed, fmt::format("the program '{}' cannot be started", command.front()));
}

Process::~Process() {
  if (process_ > 0 && trusted_) await_end();
  if (process_ > 0) {
    note_ended(process_);
    kill(-process_, SIGKILL);
  }
  close_all({input_, output_, error_});
  while (process_ > 0 && waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

/// A shutdown ends the input even where another process was just forked with a copy of our end.
void Process::leave() noexcept {
  if (left_at_) return;
  shutdown(input_, SHUT_WR);
  input_open_ = false;
  left_at_ = Clock::now();
}

/// Its last words are read, and forgotten: a program that writes to a closed or full pipe would not come to its end.
void Process::await_end() noexcept {
  leave();
  thread_local std::array<char, 1 << 16> buffer;
  std::array<pollfd, 2> ready{{{output_, POLLIN, 0}, {error_, POLLIN, 0}}};
  for (int ms = 1; runs(process_) && Clock::now() < *left_at_ + kGrace; ms = std::min(2 * ms, 20)) {
    if (poll(ready.data(), ready.size(), ms) <= 0) continue;
    for (pollfd& stream : ready)
      if (stream.revents != 0 && read_some(stream.fd, buffer) == 0) stream.fd = -1;
  }
}

bool Process::send(std::string_view& left) {
  const ssize_t n = ::send(input_, left.data(), left.size(), MSG_NOSIGNAL);
  if (n < 0) return errno == EINTR || errno == EAGAIN;
  left.remove_prefix(static_cast<std::size_t>(n));
  return true;
}

bool Process::receive() {
  thread_local std::array<char, 1 << 16> buffer;
  const ssize_t n = read_some(output_, buffer);
  if (n > 0) received_.append(buffer.data(), static_cast<std::size_t>(n));
  return n != 0;
}

void Process::read_errors() {
  thread_local std::array<char, 1 << 16> buffer;
  const ssize_t n = read_some(error_, buffer);
  if (n == 0) close(error_), error_ = -1;
  if (n <= 0) return;
  errors_.append(buffer.data(), static_cast<std::size_t>(n));
  if (errors_.size() > kLastWords) errors_.erase(0, errors_.size() - kLastWords);
}

/// True if a whole answer stands there before the message is sent; all that the program wrote since its last answer is
/// read first. Before the first message it may: some programs greet by themselves.
bool Process::has_unasked_answer(const Complete& complete, std::size_t most) {
  if (!std::exchange(spoken_, true)) return false;
  pollfd ready{output_, POLLIN, 0};
  while (received_.size() <= most && poll(&ready, 1, 0) > 0 && receive()) {
  }
  const std::size_t end = received_.empty() ? 0 : complete(received_);
  return end > 0 && end != kNoAnswer;
}

Process::Outcome Process::exchange(std::string_view message, const Complete& complete, Limits limits) {
  const Outcome outcome = heard(message, complete, limits);
  if (outcome == Outcome::answered || outcome == Outcome::unasked) return outcome;
  if (all_end) std::this_thread::sleep_for(2 * kGrace);  // kill_programs ended it: nobody is to hear of a fault
  trusted_ = false;
  return outcome;
}

Process::Outcome Process::heard(std::string_view message, const Complete& complete, Limits limits) {
  if (has_unasked_answer(complete, limits.bytes)) return Outcome::unasked;
  const auto until = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(std::min(limits.seconds, kForever)));
  for (;;) {
    const std::size_t end = received_.empty() ? 0 : complete(received_);
    if (end == kNoAnswer) return Outcome::wrong;
    if (end > 0) {
      answer_.assign(received_, 0, end);
      received_.erase(0, end);
      return Outcome::answered;
    }
    if (received_.size() > limits.bytes) return Outcome::flooded;
    const auto left_ms = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    if (left_ms <= 0) return Outcome::late;
    std::array<pollfd, 3> ready{
        {{output_, POLLIN, 0}, {error_, POLLIN, 0}, {message.empty() || !input_open_ ? -1 : input_, POLLOUT, 0}}};
    if (poll(ready.data(), ready.size(), static_cast<int>(std::min<std::int64_t>(left_ms, 1000))) < 0) continue;
    if (ready[1].revents != 0) read_errors();
    if (ready[2].revents != 0 && !send(message)) input_open_ = false;  // its end is seen at its output
    if (ready[0].revents != 0 && !receive()) return Outcome::ended;
  }
}

std::string Process::unused() const { return received_.substr(0, 200); }

std::string Process::end() {
  int status = 0;
  pid_t ended = 0;
  for (int i = 0; i < 20 && ended == 0; ++i) {  // it closed its output, and ends at any moment
    ended = waitpid(process_, &status, WNOHANG);
    if (error_ >= 0) read_errors();
    if (ended == 0) poll(nullptr, 0, 10);
  }
  if (ended == 0) return "it closed its standard output";
  if (ended == process_) {
    note_ended(process_);
    kill(-process_, SIGKILL);  // its own children
    process_ = -1;
  }
  if (WIFSIGNALED(status))
    return fmt::format("it was ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  return fmt::format("it ended with exit status {}", WEXITSTATUS(status));
}

/// It sends no SIGTERM: that ends many programs before they have read that their input ended.
void kill_programs() noexcept {
  constexpr std::chrono::duration<int, std::milli> kPause{5};
  all_end = true;
  for (const Place& place : running)
    if (const int input = place.input.load(); input >= 0) shutdown(input, SHUT_WR);
  const auto any_runs = [] {
    return std::any_of(running.begin(), running.end(), [](const Place& place) {
      const pid_t process = place.process.load();
      return process > 0 && runs(process);
    });
  };
  for (int tries = 0; tries < kGrace / kPause && any_runs(); ++tries) poll(nullptr, 0, kPause.count());
  for (const Place& place : running)
    if (const pid_t process = place.process.load(); process > 0) kill(-process, SIGKILL);
}

}  // namespace rehearse::system
