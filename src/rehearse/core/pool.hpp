#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace rehearse {

/// A pool of objects that are expensive to make and used by one call at a time; it grows to the number of concurrent
/// calls. Any thread.
template <class T>
class Pool {
 public:
  /// Takes an idle object; null if there is none: the caller makes one.
  std::unique_ptr<T> take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return nullptr;
    std::unique_ptr<T> object = std::move(idle_.back());
    idle_.pop_back();
    return object;
  }

  /// Keeps the object for another call; null is ignored.
  void give_back(std::unique_ptr<T> object) {
    if (!object) return;
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(object));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> idle_;
};

}  // namespace rehearse
