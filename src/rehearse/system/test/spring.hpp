/// A mass on a spring under two forces, the second twice as strong: x'' = −ω² x + u1 + 2 u2. State x, x'; φ: ω.
struct Equation {
  static constexpr int kStates = 2, kActions = 2, kParameters = 1;
  explicit Equation(const double* phi) : stiffness(phi[0] * phi[0]) {}
  void operator()(const auto& x, const auto* u, auto* dxdt) const {
    dxdt[0] = x[1];
    dxdt[1] = u[0] + 2 * u[1] - stiffness * x[0];
  }
  double stiffness;
};
