#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace rehearse {

/// Objects that one call uses at a time and that are dear to make: in the end as many as there are calls at a time. Any
/// thread.
template <class T>
class Pool {
 public:
  /// Null: none is idle, and the caller makes one.
  std::unique_ptr<T> take() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) return nullptr;
    std::unique_ptr<T> object = std::move(idle_.back());
    idle_.pop_back();
    return object;
  }

  /// Keeps it for another call; null is nothing.
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
