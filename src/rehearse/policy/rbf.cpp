#include "rehearse/policy/rbf.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/policy/rbf_kernel.hpp"
#include "rehearse/policy/squash.hpp"

namespace rehearse::policy {
namespace {

void check(const RbfOptions& options) {
  Violations violations;
  const Index features = options.features.features();
  violations.require(options.scale.size() == features && (options.scale.array() > 0).all(),
                     fmt::format("policy scale has {} entries, must have {}, all > 0", options.scale.size(), features));
  violations.require(options.centres >= 1, fmt::format("rbf.centres = {}, must be ≥ 1", options.centres));
  violations.require(options.noise > 0, fmt::format("rbf.noise = {}, must be > 0", options.noise));
  violations.require(!options.bounds.empty(), "policy has no actions");
  violations.throw_if_any();
}

class RbfNetwork final : public Rbf {
 public:
  explicit RbfNetwork(RbfOptions options)
      : Rbf(std::move(options)),
        inverse_scale_(options_.scale.cwiseInverse()),
        shape_{options_.features.features(), options_.centres, static_cast<Index>(options_.bounds.size()),
               options_.noise},
        squash_{.bounds = options_.bounds, .shape = Squash::Shape::sine} {}

  std::string name() const override { return "rbf"; }
  Index actions() const override { return shape_.actions; }
  Index parameters() const override { return shape_.parameters(); }

  void act(const ConstMatrixView& Theta, const ConstMatrixView& X, double, MatrixView U) const override {
    check_sizes(*this, options_.features.states(), Theta, X, U);
    thread_local Matrix inputs;
    const Index rows = X.rows();
    inputs.resize(rows, shape_.inputs);
    options_.features.apply(X, inputs);
    for (Index i = 0; i < shape_.inputs; ++i) inputs.col(i) *= inverse_scale_(i);
    rbf(shape_, Theta.data(), Theta.outerStride(), inputs.data(), rows, U.data(), U.outerStride(), rows);
    squash_.apply(U);
  }

 private:
  Vector inverse_scale_;
  RbfShape shape_;
  Squash squash_;
};

}  // namespace

std::shared_ptr<const Policy> make_rbf(RbfOptions options) {
  check(options);
  return std::make_shared<RbfNetwork>(std::move(options));
}

}  // namespace rehearse::policy
