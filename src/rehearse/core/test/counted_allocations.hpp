#pragma once
// Counts what a test's program allocates. For one source of it, and not under a sanitizer, which has a malloc of its
// own.

#include <atomic>
#include <cstdlib>

namespace {
std::atomic<long> allocations{0};
}

// Eigen allocates by malloc, as operator new does; glibc lets a program define it anew.
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) noexcept {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_malloc(size);
}
