constexpr double kGravity = 9.82;  // m/s²

/// Deisenroth 2010, appendix C.2: the pole is a rod of mass m and length l, θ = 0 hanging; the cart has mass M. State
/// x, ẋ, θ̇, θ; force on the cart; φ: m, M, l, b.
struct Equation {
  static constexpr int kStates = 4, kActions = 1, kParameters = 4, kAngles[] = {3};

  explicit Equation(const double* phi) : m(phi[0]), total(phi[0] + phi[1]), l(phi[2]), b(phi[3]) {}

  void operator()(const auto& x, const auto* u, auto* dxdt) const {
    const auto sine = sin(x[3]), cosine = cos(x[3]);
    const auto force = neg_mul_add(b, x[1], u[0]), swing = m * l * x[2] * x[2] * sine;
    const auto inverse = 1 / neg_mul_add(3 * m * l * cosine, cosine, 4 * l * total);
    dxdt[0] = x[1];
    dxdt[1] = mul_add(2 * l, swing, mul_add(4 * l, force, 3 * kGravity * m * l * sine * cosine)) * inverse;
    dxdt[2] = -(mul_add(mul_add(3, swing, 6 * force), cosine, 6 * kGravity * total * sine) * inverse);
    dxdt[3] = x[2];
  }

  double m, total, l, b;
};
