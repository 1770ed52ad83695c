#include "rehearse/policy/network.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/policy/description.hpp"
#include "rehearse/policy/layer_kernel.hpp"

namespace rehearse::policy {
namespace {

void check(const FeatureMap& features, const Vector& scale, const Squash& squash, Index hidden) {
  Violations violations;
  violations.require(
      scale.size() == features.features() && (scale.array() > 0).all(),
      fmt::format("policy scale has {} entries, must have {}, all > 0", scale.size(), features.features()));
  violations.require(hidden >= 0, fmt::format("policy hidden = {}, must be ≥ 0", hidden));
  violations.require(!squash.bounds.empty(), "policy has no actions");
  violations.throw_if_any();
}

/// `hidden` = 0: no hidden layer.
template <class Base>
class Network : public Base, public Describable {
 public:
  Network(std::string name, FeatureMap features, const Vector& scale, Index hidden, Squash squash)
      : name_(std::move(name)),
        features_(std::move(features)),
        scale_(scale),
        inverse_scale_(scale.cwiseInverse()),
        hidden_(hidden),
        squash_(std::move(squash)) {}

  std::string name() const override { return name_; }
  Index actions() const override { return static_cast<Index>(squash_.bounds.size()); }
  Index parameters() const override {
    const Index inputs = features_.features();
    return hidden_ == 0 ? actions() * (inputs + 1) : hidden_ * (inputs + 1) + actions() * (hidden_ + 1);
  }

  void act(const ConstMatrixView& Theta, const ConstMatrixView& X, double, MatrixView U) const override {
    check_sizes(*this, features_.states(), Theta, X, U);
    thread_local Matrix inputs, units;
    const Index rows = X.rows(), n = features_.features();
    inputs.resize(rows, n);
    features_.apply(X, inputs);
    for (Index i = 0; i < n; ++i) inputs.col(i) *= inverse_scale_(i);
    if (hidden_ == 0) {
      layer(Theta.data(), Theta.outerStride(), inputs.data(), rows, n, U.data(), U.outerStride(), actions(), rows,
            false);
    } else {
      units.resize(rows, hidden_);
      layer(Theta.data(), Theta.outerStride(), inputs.data(), rows, n, units.data(), rows, hidden_, rows, true);
      layer(Theta.data() + hidden_ * (n + 1) * Theta.outerStride(), Theta.outerStride(), units.data(), rows, hidden_,
            U.data(), U.outerStride(), actions(), rows, false);
    }
    squash_.apply(U);
  }

  Description describe(const ConstVectorView& theta) const override {
    const Index inputs = features_.features(), of_hidden = hidden_ * (inputs + 1);
    const auto layer_of = [&](Index first, Index outputs, Index columns) -> Matrix {
      return theta.segment(first, outputs * columns).reshaped(columns, outputs).transpose();
    };
    return Layers{.inputs = inputs_of(features_, scale_),
                  .hidden = layer_of(0, hidden_, inputs + 1),
                  .output = layer_of(of_hidden, actions(), (hidden_ == 0 ? inputs : hidden_) + 1),
                  .squash = squash_};
  }

 private:
  std::string name_;
  FeatureMap features_;
  Vector scale_, inverse_scale_;
  Index hidden_;
  Squash squash_;
};

class LinearNetwork final : public Network<Linear> {
 public:
  explicit LinearNetwork(const LinearOptions& options)
      : Network("linear", options.features, options.scale, 0, options.squash), options_(options) {}

  const LinearOptions& options() const override { return options_; }

 private:
  LinearOptions options_;
};

}  // namespace

std::shared_ptr<const Policy> make_mlp(MlpOptions options) {
  check(options.features, options.scale, options.squash, options.hidden);
  if (options.hidden < 1) throw InvalidInput(fmt::format("mlp.hidden = {}, must be ≥ 1", options.hidden));
  return std::make_shared<Network<Policy>>("mlp", std::move(options.features), options.scale, options.hidden,
                                           std::move(options.squash));
}

std::shared_ptr<const Policy> make_linear(const LinearOptions& options) {
  check(options.features, options.scale, options.squash, 0);
  return std::make_shared<LinearNetwork>(options);
}

}  // namespace rehearse::policy
