#include "rehearse/expression/slots.hpp"

#include <algorithm>
#include <memory>
#include <new>

#include "rehearse/expression/tape_kernel.hpp"

namespace rehearse::expression {
namespace {

constexpr std::align_val_t kAlignment{64};

struct Free {
  void operator()(double* p) const { ::operator delete[](p, kAlignment); }
};

}  // namespace

double* slots_of_this_thread(Index slots) {
  thread_local std::unique_ptr<double[], Free> memory;
  thread_local Index size = 0;
  if (size < slots) {
    const auto bytes = static_cast<std::size_t>(slots * kBlock) * sizeof(double);
    memory.reset(static_cast<double*>(::operator new[](bytes, kAlignment)));
    size = slots;
  }
  return memory.get();
}

void load(double* slot, const double* from, Index rows) {
  std::copy_n(from, rows, slot);
  std::fill(slot + rows, slot + (rows + 7) / 8 * 8, from[0]);
}

}  // namespace rehearse::expression
