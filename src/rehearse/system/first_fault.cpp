#include "rehearse/system/first_fault.hpp"

#include <algorithm>

namespace rehearse::system {
namespace {

/// NaN is larger than any number.
bool is_smaller(const Vector& a, const Vector& b) {
  const auto below = [](double x, double y) { return x < y || (x == x && y != y); };
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), below);
}

}  // namespace

void FirstFault::add(const ConstVectorView& x, const ConstVectorView& u, const std::string& why) {
  const std::lock_guard lock(mutex_);
  Vector row(x.size() + u.size()), before = row;
  row << x, u;
  if (fault_) before << fault_->x, fault_->u;
  if (!fault_ || is_smaller(row, before)) fault_ = Fault{x, u, why};
}

std::optional<Fault> FirstFault::get() const {
  const std::lock_guard lock(mutex_);
  return fault_;
}

void FirstFault::clear() {
  const std::lock_guard lock(mutex_);
  fault_.reset();
}

}  // namespace rehearse::system
