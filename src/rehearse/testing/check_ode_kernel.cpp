#include "rehearse/testing/check_ode_kernel.hpp"

#include <hwy/highway.h>

namespace rehearse::testing {

std::vector<std::string> check_ode_kernel(system::OdeKernel (*kernel)()) {
  std::vector<std::string> faults;
  auto& chosen = hwy::GetChosenTarget();
  const auto check = [&](const char* name, const auto& call) {
    chosen.Update(0);  // the fallback of every table, which no processor's choice is
    const auto before = chosen.GetIndex();
    call();
    if (chosen.GetIndex() != before)
      faults.push_back(std::string(name) + " chooses the instruction set anew at every call");
  };
  chosen.DeInit();  // as at the start of a program, where a scenario is made
  const system::OdeKernel made = kernel();
  const Vector x = Vector::Ones(made.states), u = Vector::Zero(made.actions), phi = Vector::Ones(made.parameters);
  Vector slope(made.states);
  Matrix dX(1, made.states);
  check("derivative", [&] { made.derivative(x.data(), u.data(), phi.data(), slope.data()); });
  check("change", [&] { made.change(x.transpose(), u.transpose(), phi.data(), 0.01, 1, dX); });
  chosen.Update(hwy::SupportedTargets());
  return faults;
}

}  // namespace rehearse::testing
