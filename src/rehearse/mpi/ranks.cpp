#include "rehearse/mpi/ranks.hpp"

#include <chrono>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>
#include <mpi.h>
#include <sched.h>
#include <unistd.h>

namespace rehearse::mpi {
namespace {

constexpr int kQuestion = 1, kAnswer = 2;

std::string receive(int source, int tag, const MPI_Status& probed) {
  int size = 0;
  MPI_Get_count(&probed, MPI_BYTE, &size);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  MPI_Recv(bytes.data(), size, MPI_BYTE, source, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  return bytes;
}

void send(const std::string& bytes, int to, int tag) {
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD);
}

/// MPI's own waiting takes a whole core, which other ranks may need where there are fewer cores.
void wait_gently(const MPI_Request& request) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  int done = 0;
  while (MPI_Request_get_status(request, &done, MPI_STATUS_IGNORE), done == 0) {
    const auto waited = Clock::now() - begin;
    if (waited > std::chrono::milliseconds(20))
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    else if (waited > std::chrono::microseconds(20))
      std::this_thread::yield();
  }
}

/// An error of MPI itself ends all ranks, as is its default.
class MpiRanks final : public Ranks {
 public:
  MpiRanks() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    if (provided < MPI_THREAD_SERIALIZED) throw std::runtime_error("this MPI cannot be used from several threads");
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  ~MpiRanks() override { MPI_Finalize(); }

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  /// Sleeps between looks, because a blocking receive would take a whole core for the time of a run.
  std::string ask(const std::string& question) override {
    const std::lock_guard lock(asking_);
    send(question, 0, kQuestion);
    while (true) {
      int there = 0;
      MPI_Status status;
      MPI_Iprobe(0, kAnswer, MPI_COMM_WORLD, &there, &status);
      if (there) return receive(0, kAnswer, status);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  bool answer(const std::function<std::string(const std::string&)>& reply) override {
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, kQuestion, MPI_COMM_WORLD, &there, &status);
    if (there) send(reply(receive(status.MPI_SOURCE, kQuestion, status)), status.MPI_SOURCE, kAnswer);
    return there != 0;
  }

 protected:
  std::vector<std::string> carry(const std::string& bytes) override {
    const auto ranks = static_cast<std::size_t>(size_);
    const int own = static_cast<int>(bytes.size());
    std::vector<int> sizes(ranks), offsets(ranks);
    MPI_Request request;
    MPI_Iallgather(&own, 1, MPI_INT, sizes.data(), 1, MPI_INT, MPI_COMM_WORLD, &request);
    wait_gently(request);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
    std::exclusive_scan(sizes.begin(), sizes.end(), offsets.begin(), 0);
    std::string all(static_cast<std::size_t>(offsets.back() + sizes.back()), '\0');
    MPI_Allgatherv(bytes.data(), own, MPI_BYTE, all.data(), sizes.data(), offsets.data(), MPI_BYTE,
                   MPI_COMM_WORLD);  // at once, because all are here by now
    std::vector<std::string> given;
    for (std::size_t i = 0; i < ranks; ++i)
      given.push_back(all.substr(static_cast<std::size_t>(offsets[i]), static_cast<std::size_t>(sizes[i])));
    return given;
  }

 private:
  int rank_ = 0, size_ = 1;
  std::mutex asking_;
};

}  // namespace

std::unique_ptr<Ranks> join() { return std::make_unique<MpiRanks>(); }

std::string cores() {
  char host[256] = {};
  ::gethostname(host, sizeof host - 1);
  cpu_set_t set;
  CPU_ZERO(&set);
  ::sched_getaffinity(0, sizeof set, &set);
  std::string text = host;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu)
    if (CPU_ISSET(cpu, &set)) text += fmt::format(" {}", cpu);
  return text;
}

}  // namespace rehearse::mpi
