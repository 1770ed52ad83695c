constexpr double kGravity = 9.82;  // m/s²

/// Chatzilygeroudis 2018, section V: absolute angles counter-clockwise from upright. A θ̈ = b, A symmetric 2 × 2. State
/// θ̇1, θ̇2, θ1, θ2; torque on the first joint; φ: m1, m2, l1, l2, b1, b2.
struct Equation {
  static constexpr int kStates = 4, kActions = 1, kParameters = 6, kAngles[] = {2, 3};
  static constexpr bool kIntegrateSines = true;

  explicit Equation(const double* phi) : b1(phi[4]), b2(phi[5]) {
    const double m1 = phi[0], m2 = phi[1], l1 = phi[2], l2 = phi[3];
    a11 = l1 * l1 * (m1 / 4 + m2) + m1 * l1 * l1 / 12;
    a22 = l2 * l2 * m2 / 4 + m2 * l2 * l2 / 12;
    coupling = 0.5 * m2 * l1 * l2;
    gravity1 = kGravity * l1 * (0.5 * m1 + m2);
    gravity2 = kGravity * 0.5 * m2 * l2;
  }

  void operator()(const auto& x, const auto* u, auto* dxdt) const {
    const auto sin1 = sin(x[2]), cos1 = cos(x[2]), sin2 = sin(x[3]), cos2 = cos(x[3]);
    const auto sin12 = neg_mul_add(cos1, sin2, sin1 * cos2), cos12 = mul_add(cos1, cos2, sin1 * sin2);
    const auto a12 = coupling * cos12, swing = coupling * sin12;
    const auto rhs1 = mul_add(gravity1, sin1, u[0]) - mul_add(swing, x[1] * x[1], b1 * x[0]);
    const auto rhs2 = mul_add(swing, x[0] * x[0], gravity2 * sin2) - b2 * x[1];
    const auto inverse = 1 / neg_mul_add(a12, a12, a11 * a22);
    dxdt[0] = neg_mul_add(a12, rhs2, a22 * rhs1) * inverse;
    dxdt[1] = neg_mul_add(a12, rhs1, a11 * rhs2) * inverse;
    dxdt[2] = x[0];
    dxdt[3] = x[1];
  }

  double a11, a22, coupling, gravity1, gravity2, b1, b2;
};
