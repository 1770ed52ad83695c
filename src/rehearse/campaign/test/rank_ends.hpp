#pragma once

#include <functional>
#include <mutex>
#include <set>
#include <string>

#include "rehearse/core/events.hpp"
#include "rehearse/core/ranks.hpp"
#include "rehearse/testing/rank_threads.hpp"

namespace rehearse::campaign {

/// The ends of a piece of work on three ranks.
class Ends {
 public:
  explicit Ends(const std::function<void(Ranks&)>& work) {
    testing::on_rank_threads(3, [&](Ranks& ranks) { add(end_of([&] { work(ranks); })), ranks.leave(0, ""); });
  }
  /// The end that all ranks have in common, or how theirs differ.
  std::string all() const {
    std::string text;
    for (const std::string& word : words_) text += (text.empty() ? "" : " | ") + word;
    return text;
  }

 private:
  static std::string end_of(const std::function<void()>& work) {
    try {
      work();
    } catch (const std::exception& error) {
      return error.what();
    } catch (const Interrupted&) {
      return "interrupted";
    }
    return "done";
  }
  void add(const std::string& word) {
    const std::lock_guard lock(mutex_);
    words_.insert(word);
  }

  std::mutex mutex_;
  std::set<std::string> words_;
};

}  // namespace rehearse::campaign
