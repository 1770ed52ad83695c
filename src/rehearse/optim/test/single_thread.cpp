// The library's user gives OpenBLAS one thread, so its tests do too. Not in a static initialiser: OpenBLAS may not have
// run its own by then, and crashes.
#include <gtest/gtest.h>

extern "C" void openblas_set_num_threads(int threads);

namespace {

struct SingleThread : testing::Environment {
  void SetUp() override { openblas_set_num_threads(1); }
};
[[maybe_unused]] const auto* environment = testing::AddGlobalTestEnvironment(new SingleThread);

}  // namespace
