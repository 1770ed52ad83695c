#include "rehearse/dynamics/servos.hpp"

#include <algorithm>
#include <map>

#include "rehearse/core/errors.hpp"
#include "rehearse/dynamics/gp_model.hpp"

namespace rehearse::dynamics {
namespace {

using Servo = Kinematics::Servo;

constexpr double kDead = 0.01;    // least ratio of squared motion to squared ways to targets; below it a servo is dead
constexpr Index kMostRows = 600;  // of a type
constexpr Index kInputs = 3, kOutputs = 2;

/// Rows × (way to the target, speed, position).
void inputs_of(const Servo& servo, const ConstMatrixView& X, const ConstMatrixView& U, MatrixView F) {
  F.col(0) = U.col(servo.action) - X.col(servo.position);
  if (servo.rate >= 0)
    F.col(1) = X.col(servo.rate);
  else
    F.col(1).setZero();
  F.col(2) = X.col(servo.position);
}

bool moves(const Servo& servo, const Dataset& data) {
  const double asked = (data.actions.col(servo.action) - data.states.col(servo.position)).squaredNorm();
  return data.changes.col(servo.position).squaredNorm() > kDead * asked;
}

struct Rows {
  Matrix inputs;   // rows × kInputs
  Matrix targets;  // rows × (way beyond the target, speed)
};

/// The training rows of all servos; evenly thinned if they are many.
Rows rows_of(const std::vector<Servo>& servos, const Dataset& data) {
  const Index n = data.size(), all = n * static_cast<Index>(servos.size());
  Rows rows{Matrix(all, kInputs), Matrix::Zero(all, kOutputs)};
  for (std::size_t i = 0; i < servos.size(); ++i) {
    const auto [action, position, rate, type] = servos[i];
    const Index first = n * static_cast<Index>(i);
    inputs_of(servos[i], data.states, data.actions, rows.inputs.middleRows(first, n));
    rows.targets.col(0).segment(first, n) =
        data.states.col(position) + data.changes.col(position) - data.actions.col(action);
    if (rate >= 0) rows.targets.col(1).segment(first, n) = data.states.col(rate) + data.changes.col(rate);
  }
  if (all <= kMostRows) return rows;
  std::vector<Index> some;
  for (Index i = 0; i < kMostRows; ++i) some.push_back(i * all / kMostRows);
  return {rows.inputs(some, Eigen::all), rows.targets(some, Eigen::all)};
}

const Matrix& inputs_of_rest(const FeatureMap& features, const ConstMatrixView& X, const ConstMatrixView& U) {
  thread_local Matrix inputs;
  inputs.resize(X.rows(), features.features() + U.cols());
  gp_inputs(features, X, U, inputs);
  return inputs;
}

/// `variance` only if wanted.
void ask(const gp::Posterior& posterior, const Matrix& inputs, bool variances, Matrix& mean, Matrix& variance) {
  mean.resize(inputs.rows(), posterior.outputs());
  if (!variances) return posterior.predict_mean(inputs, mean);
  variance.resize(inputs.rows(), posterior.outputs());
  posterior.predict(inputs, mean, variance);
}

}  // namespace

Dataset reached(Dataset data, const std::vector<Servo>& servos) {
  for (const Servo& servo : servos)
    data.actions.col(servo.action) = data.states.col(servo.position) + data.changes.col(servo.position);
  return data;
}

Servos::Servos(const Dataset& data, FeatureMap features, const std::vector<Servo>& servos, const GpOptions& options,
               const Evaluator& evaluator)
    : features_(std::move(features)), servos_(servos), variance_(options.variance) {
  if (data.size() == 0) throw InvalidInput("the data set has no row to learn from");
  std::map<Index, Type> moving;
  Type dead;
  for (const Servo& servo : servos) (moves(servo, data) ? moving[servo.type] : dead).servos.push_back(servo);
  for (auto& [type, of] : moving) types_.push_back(std::move(of));
  learn_types(data, options, evaluator);
  learn_rest(data, options, evaluator);
  types_.push_back(std::move(dead));
}

void Servos::learn_types(const Dataset& data, const GpOptions& options, const Evaluator& evaluator) {
  std::vector<gp::Inputs> inputs;
  std::vector<Matrix> targets;
  for (const Type& type : types_) {
    Rows rows = rows_of(type.servos, data);
    inputs.emplace_back(rows.inputs);
    targets.push_back(std::move(rows.targets));
  }
  std::vector<std::vector<gp::Hyperparameters>> kernels(types_.size(), std::vector<gp::Hyperparameters>(kOutputs));
  evaluator.for_each(kOutputs * static_cast<Index>(types_.size()), [&](Index i) {
    const auto m = static_cast<std::size_t>(i / kOutputs), e = static_cast<std::size_t>(i % kOutputs);
    kernels[m][e] = gp::fit(inputs[m], targets[m].col(i % kOutputs), options.fit).hyperparameters;
  });
  for (std::size_t m = 0; m < types_.size(); ++m)
    types_[m].posterior = std::make_shared<gp::Posterior>(inputs[m], targets[m], kernels[m], options.tolerance);
}

/// Learns what the GPs of the types leave. That is small and local: where nothing is known of it, it is 0.
void Servos::learn_rest(const Dataset& data, const GpOptions& options, const Evaluator& evaluator) {
  if (types_.empty()) return;
  End end;
  means(data.states, data.actions, end);
  const Matrix next = data.states + data.changes;
  std::vector<Vector> targets;
  for_each_moving([&](const Servo& servo) {
    targets.emplace_back(next.col(servo.position) - end.positions.col(servo.action));
    targets.emplace_back(servo.rate < 0 ? Vector::Zero(data.size())
                                        : Vector(next.col(servo.rate) - end.speeds.col(servo.action)));
  });
  const gp::Inputs inputs(gp_inputs(features_, data.states, data.actions));
  const gp::FitOptions fit = fit_options(options.fit, inputs.dimensions());
  const auto outputs = static_cast<Index>(targets.size());
  std::vector<gp::Fit> fits(targets.size());
  evaluator.for_each(outputs, [&](Index e) {
    const auto i = static_cast<std::size_t>(e);
    fits[i] = gp::fit(inputs, targets[i], fit);
  });
  Matrix Y(data.size(), outputs);
  std::vector<gp::Hyperparameters> kernels;
  for (Index e = 0; e < outputs; ++e) {
    const auto i = static_cast<std::size_t>(e);
    Y.col(e) = targets[i];
    kernels.push_back(fits[i].hyperparameters);
    log_evidence_ += fits[i].log_evidence;
  }
  rest_ = std::make_shared<gp::Posterior>(inputs, Y, std::move(kernels), options.tolerance);
}

template <class Visit>
void Servos::for_each_moving(Visit visit) const {
  for (const Type& type : types_) {
    if (!type.posterior) continue;
    for (const Servo& servo : type.servos) visit(servo);
  }
}

void Servos::means(const ConstMatrixView& X, const ConstMatrixView& U, End& end) const { forward(X, U, false, end); }

void Servos::predict(const ConstMatrixView& X, const ConstMatrixView& U, End& end) const { forward(X, U, true, end); }

void Servos::forward(const ConstMatrixView& X, const ConstMatrixView& U, bool variances, End& end) const {
  thread_local Matrix inputs, mean, variance;
  const Index n = X.rows();
  end.positions = U;
  end.speeds.setZero(n, U.cols());
  end.position_variances.setZero(variances ? n : 0, U.cols());
  end.speed_variances.setZero(variances ? n : 0, U.cols());
  // part(outputs): n × (position, speed).
  const auto add = [&](const Servo& servo, auto part) {
    end.positions.col(servo.action) += part(mean).col(0);
    end.speeds.col(servo.action) += part(mean).col(1);
    if (!variances) return;
    end.position_variances.col(servo.action) += part(variance).col(0);
    end.speed_variances.col(servo.action) += part(variance).col(1);
  };
  for (const auto& [servos, posterior] : types_) {
    if (!posterior) {
      for (const Servo& servo : servos) end.positions.col(servo.action) = X.col(servo.position);
      continue;
    }
    const auto count = static_cast<Index>(servos.size());
    inputs.resize(n * count, kInputs);
    for (Index i = 0; i < count; ++i) inputs_of(servos[static_cast<std::size_t>(i)], X, U, inputs.middleRows(n * i, n));
    ask(*posterior, inputs, variances, mean, variance);
    for (Index i = 0; i < count; ++i)
      add(servos[static_cast<std::size_t>(i)], [&](const Matrix& outputs) { return outputs.middleRows(n * i, n); });
  }
  if (!rest_) return;
  ask(*rest_, inputs_of_rest(features_, X, U), variances, mean, variance);
  if (variances && variance_ == PredictedVariance::noisy) variance.rowwise() += rest_->noise_variances().transpose();
  Index e = 0;
  for_each_moving([&](const Servo& servo) {
    add(servo, [&](const Matrix& outputs) { return outputs.middleCols(e, kOutputs); });
    e += kOutputs;
  });
}

void Servos::replace_targets(const End& end, MatrixView U) const {
  for (const Servo& servo : servos_) U.col(servo.action) = end.positions.col(servo.action);
}

namespace {

/// The changes of servos' states.
void write_changes(const std::vector<Servo>& servos, const ConstMatrixView& X, const Servos::End& end,
                   MatrixView change) {
  for (const auto& [action, position, rate, type] : servos) {
    change.col(position) = end.positions.col(action) - X.col(position);
    if (rate >= 0) change.col(rate) = end.speeds.col(action) - X.col(rate);
  }
}

/// move(end): where the servos get to; follow(actions): what the body makes of that. The end, until the next call.
template <class Move, class Follow>
const Servos::End& go(const Servos& servos, const ConstMatrixView& X, const ConstMatrixView& U, MatrixView change,
                      Move move, Follow follow) {
  thread_local Servos::End end;
  thread_local Matrix reached;
  move(end);
  reached = U;
  servos.replace_targets(end, reached);
  follow(reached);
  write_changes(servos.servos(), X, end, change);
  return end;
}

}  // namespace

void ServoModel::predict(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean,
                         MatrixView variance) const {
  const Servos::End& end = go(
      *servos_, X, U, mean, [&](Servos::End& end) { servos_->predict(X, U, end); },
      [&](const Matrix& reached) { body_->predict(X, reached, mean, variance); });
  for (const auto& [action, position, rate, type] : servos_->servos()) {
    variance.col(position) = end.position_variances.col(action);
    if (rate >= 0) variance.col(rate) = end.speed_variances.col(action);
  }
}

void ServoModel::predict_mean(const ConstMatrixView& X, const ConstMatrixView& U, MatrixView mean) const {
  go(
      *servos_, X, U, mean, [&](Servos::End& end) { servos_->means(X, U, end); },
      [&](const Matrix& reached) { body_->predict_mean(X, reached, mean); });
}

void ServoModel::sample(const ConstMatrixView& X, const ConstMatrixView& U, const ConstMatrixView& normals,
                        MatrixView change) const {
  const auto draw = [&](Servos::End& end) {
    servos_->predict(X, U, end);
    for (const auto& [action, position, rate, type] : servos_->servos()) {
      end.positions.col(action).array() +=
          normals.col(position).array() * end.position_variances.col(action).array().sqrt();
      if (rate >= 0)
        end.speeds.col(action).array() += normals.col(rate).array() * end.speed_variances.col(action).array().sqrt();
    }
  };
  go(*servos_, X, U, change, draw, [&](const Matrix& reached) { body_->sample(X, reached, normals, change); });
}

}  // namespace rehearse::dynamics
