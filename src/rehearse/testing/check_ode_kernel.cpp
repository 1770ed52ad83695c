#include "rehearse/testing/check_ode_kernel.hpp"

#include <hwy/highway.h>

namespace rehearse::testing {

std::vector<std::string> check_ode_kernel(system::OdeKernel (*kernel)(), const Vector& x, const Vector& phi) {
  std::vector<std::string> faults;
  auto& chosen = hwy::GetChosenTarget();
  const auto check = [&](const char* name, const auto& call) {
    chosen.Update(HWY_STATIC_TARGET);
    const auto before = chosen.GetIndex();
    call();
    if (chosen.GetIndex() != before)
      faults.push_back(std::string(name) + " chooses the instruction set anew at every call");
  };
  chosen.DeInit();  // as at the start of a program, where a scenario is made
  const system::OdeKernel made = kernel();
  Vector out(x.size());
  const double u = 0;
  check("derivative", [&] { made.derivative(x.data(), u, phi.data(), out.data()); });
  check("change", [&] { made.change(x.data(), 1, &u, phi.data(), 0.01, 1, out.data(), 1, 1); });
  chosen.Update(hwy::SupportedTargets());
  return faults;
}

}  // namespace rehearse::testing
