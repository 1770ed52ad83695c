/// Two pendulums side by side, both driven, coupled by a spring of angle. State ω1, θ1, ω2, θ2; φ: stiffness.
struct Equation {
  static constexpr int kStates = 4, kActions = 2, kParameters = 1, kAngles[] = {1, 3};
#ifdef INTEGRATE_SINES
  static constexpr bool kIntegrateSines = true;
#endif
  explicit Equation(const double* phi) : stiffness(phi[0]) {}
  void operator()(const auto& x, const auto* u, auto* dxdt) const {
    const auto pull = stiffness * neg_mul_add(cos(x[1]), sin(x[3]), sin(x[1]) * cos(x[3]));  // sin(θ1 − θ2)
    dxdt[0] = u[0] - mul_add(9.82, sin(x[1]), pull);
    dxdt[1] = x[0];
    dxdt[2] = u[1] + neg_mul_add(9.82, sin(x[3]), pull);
    dxdt[3] = x[2];
  }
  double stiffness;
};
