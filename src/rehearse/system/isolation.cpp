#include "rehearse/system/isolation.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "rehearse/system/workers.hpp"

namespace rehearse::system {
namespace {

/// Sizes of a request. Then come φ, and the states and actions row by row; the answer is the changes row by row.
struct Request {
  std::int64_t rows = 0, states = 0, actions = 0, parameters = 0;
  std::size_t row_size() const { return static_cast<std::size_t>(states + actions); }
  std::size_t size() const {
    return static_cast<std::size_t>(parameters) + static_cast<std::size_t>(rows) * row_size();
  }
};

using Clock = std::chrono::steady_clock;

/// Receives bytes; true if all arrived. until: gives up then.
bool receive(int socket, void* data, std::size_t bytes, std::optional<Clock::time_point> until = {}) {
  auto* at = static_cast<char*>(data);
  while (bytes > 0) {
    if (until) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(*until - Clock::now()).count();
      pollfd ready{socket, POLLIN, 0};
      const int n = left > 0 ? poll(&ready, 1, static_cast<int>(std::min<std::int64_t>(left, 1 << 30))) : 0;
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
    }
    const ssize_t n = recv(socket, at, bytes, 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

bool send_all(int socket, const void* data, std::size_t bytes) {
  const auto* at = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t n = send(socket, at, bytes, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

/// The work of the new process until its socket is closed.
class Server {
 public:
  Server(const Simulator& simulator, int socket) : simulator_(simulator), socket_(socket) {}

  [[noreturn]] void run() {
    leave_the_parents_things();
    try {
      Request request;
      while (receive(socket_, &request, sizeof request) && answer(request)) {
      }
    } catch (...) {  // memory may be used up; nothing of the parent's stack is unwound here
      _exit(1);
    }
    _exit(0);
  }

 private:
  /// Gives up the parent's files, its terminal and its handlers of signals. The parent ends us by ending itself.
  void leave_the_parents_things() const {
    prctl(PR_SET_NAME, "rehearse-worker");
    for (const int number : {SIGTERM, SIGABRT, SIGSEGV, SIGFPE, SIGILL, SIGBUS}) std::signal(number, SIG_DFL);
    std::signal(SIGINT, SIG_IGN);
    end_with_the_parent();
    constexpr rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    const int nowhere = open("/dev/null", O_RDWR);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, standard);
    const auto socket = static_cast<unsigned>(socket_);
    if (socket > 3) close_range(3, socket - 1, 0);
    close_range(socket + 1, ~0U, 0);
  }

  /// A row that never ends does not see that the socket is closed. The kernel's signal of a parent's death would come
  /// with the end of the thread that forked, so we look once a second.
  static void end_with_the_parent() {
    static pid_t parent;
    parent = getppid();
    struct sigaction look {};
    look.sa_handler = [](int) {
      if (getppid() != parent) _exit(0);
    };
    look.sa_flags = SA_RESTART;
    sigaction(SIGALRM, &look, nullptr);
    constexpr itimerval every_second{{1, 0}, {1, 0}};
    setitimer(ITIMER_REAL, &every_second, nullptr);
  }

  bool answer(const Request& request) {
    numbers_.resize(request.size());
    if (!receive(socket_, numbers_.data(), sizeof(double) * numbers_.size())) return false;
    const double* at = numbers_.data();
    const Vector phi = Eigen::Map<const Vector>(at, request.parameters);
    Matrix dX(1, request.states);
    for (std::int64_t i = 0; i < request.rows; ++i) {
      const double* row = at + request.parameters + i * static_cast<std::int64_t>(request.row_size());
      const Matrix X = Eigen::Map<const Matrix>(row, 1, request.states);
      const Matrix U = Eigen::Map<const Matrix>(row + request.states, 1, request.actions);
      change_contained(simulator_, X, U, phi, dX);
      if (!send_all(socket_, dX.data(), sizeof(double) * static_cast<std::size_t>(dX.size()))) return false;
    }
    return true;
  }

  const Simulator& simulator_;
  int socket_;
  std::vector<double> numbers_;
};

/// A process that simulates, seen from outside.
class ForkedWorker final : public Worker {
 public:
  ForkedWorker(const Simulator& simulator, double row_s) : row_s_(row_s) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) fail(errno);
    process_ = fork();
    if (process_ == 0) Server(simulator, ends[1]).run();
    close(ends[1]);
    socket_ = ends[0];
    if (process_ > 0) return;
    const int why = errno;
    close(socket_);
    fail(why);
  }
  ~ForkedWorker() override {
    close(socket_);
    kill(process_, SIGKILL);
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  ForkedWorker(const ForkedWorker&) = delete;
  ForkedWorker& operator=(const ForkedWorker&) = delete;

  Index change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) override {
    const Request request{X.rows(), X.cols(), U.cols(), phi.size()};
    numbers_.resize(request.size());
    double* at = numbers_.data();
    Eigen::Map<Vector>(at, phi.size()) = phi;
    at += phi.size();
    for (Index i = 0; i < X.rows(); ++i, at += request.row_size()) {
      Eigen::Map<RowVector>(at, X.cols()) = X.row(i);
      Eigen::Map<RowVector>(at + X.cols(), U.cols()) = U.row(i);
    }
    if (!send_all(socket_, &request, sizeof request) ||
        !send_all(socket_, numbers_.data(), sizeof(double) * numbers_.size()))
      return 0;
    const auto limit = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(row_s_));
    for (Index i = 0; i < X.rows(); ++i) {
      if (!receive(socket_, numbers_.data(), sizeof(double) * static_cast<std::size_t>(X.cols()), Clock::now() + limit))
        return i;
      dX.row(i) = Eigen::Map<const RowVector>(numbers_.data(), X.cols());
    }
    return X.rows();
  }

 private:
  using RowVector = Eigen::RowVectorXd;

  [[noreturn]] static void fail(int why) {
    throw Unavailable(fmt::format("no process can be made for the simulator: {}", std::strerror(why)));
  }

  double row_s_;
  pid_t process_ = -1;
  int socket_ = -1;
  std::vector<double> numbers_;
};

class Isolated final : public Simulator {
 public:
  Isolated(std::shared_ptr<const Simulator> simulator, double row_s)
      : simulator_(simulator),
        workers_({.start = [simulator, row_s] { return std::make_unique<ForkedWorker>(*simulator, row_s); },
                  .row_by_row = true}) {}

  const ParameterSpace& parameters() const override { return simulator_->parameters(); }

  void change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) const override {
    check_sizes(*this, X, U, phi, dX);
    workers_.change(X, U, phi, dX);
  }

 private:
  std::shared_ptr<const Simulator> simulator_;
  Workers workers_;
};

}  // namespace

std::shared_ptr<const Simulator> isolated(std::shared_ptr<const Simulator> simulator, double row_s) {
  return std::make_shared<Isolated>(std::move(simulator), row_s);
}

}  // namespace rehearse::system
