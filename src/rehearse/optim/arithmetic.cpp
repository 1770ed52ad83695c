#include "rehearse/optim/arithmetic.hpp"

#include <fmt/format.h>
#include <gnu/libc-version.h>

#include "rehearse/core/vector_math.hpp"

extern "C" char* openblas_get_corename();

namespace rehearse::optim {

std::string arithmetic() {
  return fmt::format("Highway {}, OpenBLAS {}, glibc {}", vector_target(), openblas_get_corename(),
                     gnu_get_libc_version());
}

}  // namespace rehearse::optim
