#include "rehearse/policy/network.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/feature_slopes.hpp"
#include "rehearse/core/vector_math.hpp"
#include "rehearse/policy/description.hpp"
#include "rehearse/policy/differentiable.hpp"
#include "rehearse/policy/layer_kernel.hpp"
#include "rehearse/policy/squash_slope.hpp"

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

/// A layer of rows that share θ: of each output the weights and the bias, from θ(first) on.
struct Weights {
  const ConstVectorView& theta;
  VectorView& by_theta;
  Index first, inputs, outputs;

  void forward(const Matrix& in, Matrix& out) const {
    const auto W = theta.segment(first, (inputs + 1) * outputs).reshaped(inputs + 1, outputs);
    out.noalias() = in.lazyProduct(W.topRows(inputs));
    out.rowwise() += W.row(inputs);
  }

  void backward(const Matrix& in, const Matrix& by_out, Matrix& by_in) const {
    const auto W = theta.segment(first, (inputs + 1) * outputs).reshaped(inputs + 1, outputs);
    auto by_W = by_theta.segment(first, (inputs + 1) * outputs).reshaped(inputs + 1, outputs);
    by_W.topRows(inputs) += in.transpose().lazyProduct(by_out);
    by_W.row(inputs) += by_out.colwise().sum();
    by_in.noalias() = by_out.lazyProduct(W.topRows(inputs).transpose());
  }
};

/// `hidden` = 0: no hidden layer.
template <class Base>
class Network : public Base, public Describable, public Differentiable {
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
    scale(inputs);
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

  void pull_back(const ConstVectorView& theta, const ConstMatrixView& X, const ConstMatrixView& by_actions,
                 MatrixView by_states, VectorView by_theta) const override {
    thread_local Matrix features, inputs, units, by_outputs, by_units, by_inputs;
    features.resize(X.rows(), features_.features());
    features_.apply(X, features);
    inputs = features;
    scale(inputs);
    const Index of_hidden = hidden_ * (inputs.cols() + 1);
    const auto all = [&](Index first, const Matrix& from, Index outputs) {
      return Weights{theta, by_theta, first, from.cols(), outputs};
    };
    const Weights hidden = all(0, inputs, hidden_);
    if (hidden_ > 0) {
      hidden.forward(inputs, units);
      vector_tanh(units.data(), units.data(), units.size());
    }
    const Matrix& last = hidden_ > 0 ? units : inputs;
    const Weights output = all(of_hidden, last, actions());
    output.forward(last, by_outputs);
    squash_slope(squash_, by_outputs);
    by_outputs.array() *= by_actions.array();
    output.backward(last, by_outputs, hidden_ > 0 ? by_units : by_inputs);
    if (hidden_ > 0) {
      by_units.array() *= 1 - units.array().square();
      hidden.backward(inputs, by_units, by_inputs);
    }
    scale(by_inputs);
    pull_back_features(features_, features, by_inputs, by_states);
  }

  std::vector<Index> unit_weights() const override {
    std::vector<Index> weights;
    for (Index i = hidden_ * (features_.features() + 1); hidden_ > 0 && i < parameters(); ++i)
      if ((parameters() - 1 - i) % (hidden_ + 1) != 0) weights.push_back(i);  // no bias, the last of each output
    return weights;
  }

  Description describe(const ConstVectorView& theta) const override {
    const Index inputs = features_.features(), of_hidden = hidden_ * (inputs + 1);
    const auto layer_of = [&](Index first, Index outputs, Index columns) -> Matrix {
      return theta.segment(first, outputs * columns).reshaped(columns, outputs).transpose();
    };
    return {Layers{.inputs = inputs_of(features_, scale_),
                   .hidden = layer_of(0, hidden_, inputs + 1),
                   .output = layer_of(of_hidden, actions(), (hidden_ == 0 ? inputs : hidden_) + 1),
                   .squash = squash_}};
  }

 private:
  void scale(Matrix& inputs) const {
    for (Index i = 0; i < inputs.cols(); ++i) inputs.col(i) *= inverse_scale_(i);
  }

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
