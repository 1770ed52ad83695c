/// A state for each function of a number; the slopes depend on the action alone. φ: what is added to it.
struct Equation {
  static constexpr int kStates = 10, kActions = 1, kParameters = 1;
  explicit Equation(const double* phi) : offset(phi[0]) {}
  void operator()(const auto&, const auto* u, auto* dxdt) const {
    const auto a = u[0] + offset;
    auto sum = a;
    sum += 3, sum *= a, sum -= 1, sum /= 2;
    int i = 0;
    for (const auto& f : {sin(a), cos(a), exp(a), tanh(a), sqrt(a), abs(-a), mul_add(a, 2, 3), neg_mul_add(2, a, 3),
                          1 / a - a * 0.5, sum})
      dxdt[i++] = f;
  }
  double offset;
};
