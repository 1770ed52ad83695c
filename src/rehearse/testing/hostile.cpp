#include "rehearse/testing/hostile.hpp"

#include <bit>
#include <cstdint>
#include <stdexcept>

namespace rehearse::testing {
namespace {

/// The finaliser of SplitMix64 (Steele 2014) over the bits of the row's numbers; uniform in [0, 1).
double hash(const ConstMatrixView& X, const ConstMatrixView& U, Index row) {
  std::uint64_t h = 0;
  const auto mix = [&](double value) {
    h = (h ^ std::bit_cast<std::uint64_t>(value)) + 0x9e3779b97f4a7c15;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9;
    h = (h ^ (h >> 27)) * 0x94d049bb133111eb;
    h ^= h >> 31;
  };
  for (Index c = 0; c < X.cols(); ++c) mix(X(row, c));
  for (Index c = 0; c < U.cols(); ++c) mix(U(row, c));
  return static_cast<double>(h >> 11) * 0x1.0p-53;
}

class Hostile final : public system::Simulator {
 public:
  Hostile(std::shared_ptr<const system::Simulator> simulator, Harm harm, double fraction)
      : simulator_(std::move(simulator)), harm_(harm), fraction_(fraction) {}

  const ParameterSpace& parameters() const override { return simulator_->parameters(); }

  void change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) const override {
    simulator_->change(X, U, phi, dX);
    for (Index row = 0; row < X.rows(); ++row) {
      if (hash(X, U, row) >= fraction_) continue;
      if (harm_ == Harm::exception) throw std::runtime_error("a row that cannot be simulated");
      dX.row(row).setConstant(harm_ == Harm::nan ? kNaN : 1e300);
    }
  }

 private:
  std::shared_ptr<const system::Simulator> simulator_;
  Harm harm_;
  double fraction_;
};

}  // namespace

std::shared_ptr<const system::Simulator> make_hostile(std::shared_ptr<const system::Simulator> simulator, Harm harm,
                                                      double fraction) {
  return std::make_shared<Hostile>(std::move(simulator), harm, fraction);
}

}  // namespace rehearse::testing
