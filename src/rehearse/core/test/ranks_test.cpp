#include "rehearse/core/ranks.hpp"

#include <atomic>
#include <map>
#include <mutex>
#include <stdexcept>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/testing/rank_threads.hpp"

namespace rehearse {
namespace {

using testing::on_rank_threads;

/// The words of each rank, however it ends.
class Words {
 public:
  void add(const Ranks& ranks, const std::string& word) {
    const std::lock_guard lock(mutex_);
    words_[ranks.rank()] += word;
  }
  const std::map<int, std::string>& all() const { return words_; }
  static std::map<int, std::string> same(int size, const std::string& word) {
    std::map<int, std::string> all;
    for (int rank = 0; rank < size; ++rank) all[rank] = word;
    return all;
  }

 private:
  std::mutex mutex_;
  std::map<int, std::string> words_;
};

template <class Action>
std::string caught(Action action) {
  try {
    action();
  } catch (const InvalidInput& error) {
    return std::string("input: ") + error.what();
  } catch (const std::exception& error) {
    return std::string("error: ") + error.what();
  } catch (const Interrupted&) {
    return "interrupted";
  }
  return "";
}

TEST(Ranks, ExchangeInTheOrderOfRanks) {
  Words words;
  on_rank_threads(3, [&](Ranks& ranks) {
    for (const std::string& given : ranks.exchange("here", std::string(1, static_cast<char>('a' + ranks.rank()))))
      words.add(ranks, given);
  });
  EXPECT_EQ(words.all(), Words::same(3, "abc"));
}

TEST(Ranks, OnceOnTheFirstRankAlone) {
  std::atomic<int> calls{0};
  Words words;
  on_rank_threads(3, [&](Ranks& ranks) {
    words.add(ranks, ranks.once("step", [&] { return ++calls, std::string("a\0b", 3); }));
    words.add(ranks, ranks.once("step", [&] { return std::string(); }));
    words.add(ranks,
              caught([&] { ranks.once("step", []() -> std::string { throw InvalidInput("no such folder"); }); }));
    words.add(ranks, caught([&] { ranks.once("step", []() -> std::string { throw std::range_error("too far"); }); }));
    words.add(ranks, caught([&] { ranks.once("step", []() -> std::string { throw Interrupted{}; }); }));
  });
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(words.all(),
            Words::same(3, std::string("a\0b", 3) + "input: no such folder" + "error: too far" + "interrupted"));
}

TEST(Ranks, WhoLeavesEarlyIsNotWaitedFor) {
  Words words;
  on_rank_threads(3, [&](Ranks& ranks) {
    if (ranks.rank() == 1) {
      EXPECT_EQ(ranks.leave(1, "out of memory").size(), 1u);
    } else {
      words.add(ranks, caught([&] { ranks.once("step", [] { return ""; }); }));
      words.add(ranks, caught([&] { ranks.once("step", [] { return ""; }); }));
    }
    EXPECT_EQ(ranks.leave(1, "").size(), 1u);
  });
  const std::string both = "error: rank 1 failed: out of memoryerror: the ranks have parted";
  EXPECT_EQ(words.all(), (std::map<int, std::string>{{0, both}, {2, both}}));
}

TEST(Ranks, LeaveTogether) {
  on_rank_threads(3, [&](Ranks& ranks) {
    const auto ends = ranks.leave(ranks.rank(), std::string(ranks.rank(), 'x'));
    ASSERT_EQ(ends.size(), 3u);
    EXPECT_EQ(ends[0].code, 0);
    EXPECT_EQ(ends[2].code, 2);
    EXPECT_EQ(ends[2].message, "xx");
  });
}

TEST(Ranks, WhoComputesSomethingElseIsFoundOut) {
  Words words;
  on_rank_threads(3, [&](Ranks& ranks) {
    words.add(ranks, caught([&] {
                       ranks.exchange(ranks.rank() == 2 ? "evaluate 3 x 4" : "evaluate 3 x 5", "");
                     }).substr(0, 41));
    EXPECT_EQ(ranks.leave(1, "").size(), 1u);
  });
  EXPECT_EQ(words.all(), Words::same(3, "error: the ranks do not compute the same:"));
}

TEST(Ranks, WorkOnceIsTheSameWork) {
  Words words;
  on_rank_threads(2, [&](Ranks& ranks) {
    words.add(ranks, caught([&] { ranks.once(ranks.rank() == 0 ? "episode 3" : "episode 4", [] { return ""; }); }));
    EXPECT_EQ(ranks.leave(1, "").size(), 1u);
  });
  const std::string differ = "error: the ranks do not compute the same: ";
  EXPECT_EQ(words.all(), (std::map<int, std::string>{{0, differ + "rank 0 is at 'episode 3', rank 1 at 'episode 4'"},
                                                     {1, differ + "rank 1 is at 'episode 4', rank 0 at 'episode 3'"}}));
}

TEST(Ranks, QuestionsFromAllThreads) {
  on_rank_threads(3, [&](Ranks& ranks) {
    if (ranks.rank() > 0) {
      make_thread_evaluator(2)->for_each(10, [&](Index i) {
        const std::string text = std::to_string(ranks.rank()) + " " + std::to_string(i);
        EXPECT_EQ(ranks.ask(text), "<" + text + ">");
      });
      return;
    }
    for (int answered = 0; answered < 20;)
      answered += ranks.answer([](const std::string& question) { return "<" + question + ">"; });
  });
}

}  // namespace
}  // namespace rehearse
