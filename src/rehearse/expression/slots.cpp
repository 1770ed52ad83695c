#include "rehearse/expression/slots.hpp"

#include <algorithm>
#include <memory>
#include <new>

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
  std::fill(slot + rows, slot + whole_vectors(rows), from[0]);
}

void fill(double* slot, double value, Index rows) { std::fill_n(slot, whole_vectors(rows), value); }

void fill_constants(const Tape& tape, const Block& block) {
  double* slot = block.slots;
  for (const double constant : tape.constants) {
    fill(slot, constant, block.rows);
    slot += kBlock;
  }
}

Code code_of(const Tape& tape, Pace pace) {
  const auto& code = tape.code[static_cast<std::size_t>(pace)];
  return {code.data(), static_cast<Index>(code.size())};
}

}  // namespace rehearse::expression
