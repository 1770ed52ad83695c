#include "rehearse/testing/rank_threads.hpp"

#include <barrier>
#include <deque>
#include <future>
#include <mutex>
#include <thread>

namespace rehearse::testing {
namespace {

/// The state shared by the ranks.
struct Shared {
  explicit Shared(int size) : given(static_cast<std::size_t>(size)), together(size) {}

  struct Question {
    std::string text;
    std::promise<std::string> answer;
  };

  std::vector<std::string> given;
  std::barrier<> together;
  std::mutex mutex;
  std::deque<Question> questions;
};

class RankThread final : public Ranks {
 public:
  RankThread(int rank, Shared& shared) : rank_(rank), shared_(shared) {}

  int rank() const override { return rank_; }
  int size() const override { return static_cast<int>(shared_.given.size()); }

  std::string ask(const std::string& question) override {
    std::future<std::string> answer;
    {
      const std::lock_guard lock(shared_.mutex);
      shared_.questions.push_back({question, {}});
      answer = shared_.questions.back().answer.get_future();
    }
    return answer.get();
  }

  bool answer(const std::function<std::string(const std::string&)>& reply) override {
    Shared::Question question;
    {
      const std::lock_guard lock(shared_.mutex);
      if (shared_.questions.empty()) return false;
      question = std::move(shared_.questions.front());
      shared_.questions.pop_front();
    }
    question.answer.set_value(reply(question.text));
    return true;
  }

 protected:
  std::vector<std::string> carry(const std::string& bytes) override {
    shared_.given[static_cast<std::size_t>(rank_)] = bytes;
    shared_.together.arrive_and_wait();
    std::vector<std::string> all = shared_.given;
    shared_.together.arrive_and_wait();
    return all;
  }

 private:
  int rank_;
  Shared& shared_;
};

}  // namespace

void on_rank_threads(int size, const std::function<void(Ranks&)>& work) {
  Shared shared(size);
  std::vector<std::thread> threads;
  threads.reserve(static_cast<std::size_t>(size));
  for (int rank = 0; rank < size; ++rank)
    threads.emplace_back([&, rank] {
      RankThread own(rank, shared);
      work(own);
    });
  for (std::thread& thread : threads) thread.join();
}

}  // namespace rehearse::testing
