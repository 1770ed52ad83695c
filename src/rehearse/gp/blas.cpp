#include "rehearse/gp/blas.hpp"

extern "C" {
void openblas_set_num_threads(int threads);
char* openblas_get_corename();
}

namespace rehearse::gp {

void use_one_blas_thread() {
  static const bool done = (openblas_set_num_threads(1), true);
  (void)done;
}

std::string blas_core() { return openblas_get_corename(); }

}  // namespace rehearse::gp
