#pragma once

#include <time.h>

namespace rehearse::benchmarks {

/// Processor time of this process, s: other work on the machine does not count.
inline double cpu_s() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace rehearse::benchmarks
