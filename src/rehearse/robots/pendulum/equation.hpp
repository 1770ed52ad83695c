constexpr double kGravity = 9.82;  // m/s²

/// A rod of mass m and length l with a torque on its axis; θ = 0 hanging. θ̈ m l²/3 = u − b θ̇ − m g l sin(θ)/2. State
/// θ̇, θ; φ: m, l, b.
struct Equation {
  static constexpr int kStates = 2, kActions = 1, kParameters = 3, kAngles[] = {1};

  explicit Equation(const double* phi) {
    const double m = phi[0], l = phi[1], b = phi[2], inertia = m * l * l / 3;
    torque = 1 / inertia, friction = b / inertia, gravity = m * kGravity * l / 2 / inertia;
  }

  void operator()(const auto& x, const auto* u, auto* dxdt) const {
    dxdt[0] = torque * u[0] - mul_add(friction, x[0], gravity * sin(x[1]));
    dxdt[1] = x[0];
  }

  double torque, friction, gravity;
};
