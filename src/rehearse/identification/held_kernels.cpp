#include "rehearse/identification/held_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "rehearse/optim/damping.hpp"
#include "rehearse/optim/derivative_free.hpp"

namespace rehearse::identification {
namespace {

constexpr double kGain = 1e-3;  // nats: steps that promise or gain less are not made
constexpr double kLeastDamping = 1e-9;
constexpr int kMostHeldSteps = 30, kMostDampings = 10;

optim::SubplexOptions subplex(Index parameters) {
  return {.max_evaluations = 50 * parameters, .x_tolerance = 1e-6, .value_tolerance = 1e-8, .first_step = 0.01};
}

class Climb {
 public:
  explicit Climb(const HeldKernels& held) : held_(held), z_(held.start()), at_(held.at(z_)) {}

  void run() {
    for (int i = 0; i < kMostHeldSteps && std::isfinite(at_.score); ++i) {
      const double before = at_.score;
      const Made made = step();
      if (made == Made::none) return;
      if (made == Made::misled) search();
      if (!(at_.score - before >= kGain)) return;
    }
  }

  const Vector& z() const { return z_; }
  double score() const { return at_.score; }
  Index evaluations() const { return evaluations_; }

 private:
  enum class Made { one, none, misled };

  Made step() {
    const Quadratics model = held_.quadratics(z_, at_);
    for (int i = 0; i < kMostDampings; ++i) {
      const Vector d = best_step(model, held_.problem().score, -z_, Vector::Ones(z_.size()) - z_, damping_.value());
      const double promised = held_.score(model.at(d)) - at_.score;
      if (!(promised >= kGain)) return i == 0 ? Made::none : Made::misled;
      if (move((z_ + d).cwiseMax(0).cwiseMin(1), promised)) return Made::one;
      damping_.refuse();
    }
    return Made::misled;
  }

  /// Moves to z if the score is higher there; false if not.
  bool move(const Vector& z, double promised) {
    HeldKernels::At next = held_.at(z);
    ++evaluations_;
    const double gain = next.score - at_.score;
    if (!(gain > 0)) return false;
    damping_.judge(gain, promised);
    z_ = z;
    at_ = std::move(next);
    return true;
  }

  void search() {
    const std::vector<Interval> box(static_cast<std::size_t>(z_.size()), {0, 1});
    const auto score = [&](const Vector& z) { return held_.at(z).score; };
    const auto found = optim::maximise_subplex(score, z_, box, subplex(z_.size()));
    evaluations_ += found.evaluations;
    if (found.value > at_.score) z_ = found.x, at_ = held_.at(z_);
  }

  const HeldKernels& held_;
  Vector z_;
  HeldKernels::At at_;
  optim::Damping damping_{kLeastDamping};
  Index evaluations_ = 0;
};

}  // namespace

HeldKernels::HeldKernels(const FitProblem& problem, const Fit& fit)
    : problem_(problem), coordinates_(problem.prior->space, fit.phi) {
  const dynamics::Residuals::Rows rows = problem.residuals.at(problem.prior, fit.phi);
  kept_ = rows.kept;
  left_out_ = rows.left_out;
  std::vector<std::optional<gp::Whitening>> made(fit.kernels.size());
  problem.evaluator.for_each(static_cast<Index>(made.size()), [&](Index j) {
    const auto k = static_cast<std::size_t>(j);
    made[k].emplace(*rows.inputs, fit.kernels[k].hyperparameters);
  });
  for (auto& whitening : made) whitenings_.push_back(std::move(*whitening));
}

/// Targets of the rows of the fit.
Matrix HeldKernels::targets(const Vector& z) const {
  Matrix all = problem_.residuals.targets(problem_.prior, phi(z));
  if (kept_.empty()) return all;
  return all(kept_, Eigen::all);
}

HeldKernels::At HeldKernels::at(const Vector& z) const {
  At at{targets(z), {}, {}, -kInf};
  if (!at.targets.allFinite()) return at;
  const Index outputs = at.targets.cols();
  at.whitened.resize(at.targets.rows(), outputs);
  at.log_evidences.resize(outputs);
  problem_.evaluator.for_each(outputs, [&](Index e) {
    const gp::Whitening& whiten = whitenings_[static_cast<std::size_t>(e)];
    at.whitened.col(e) = whiten(at.targets.col(e));
    at.log_evidences(e) = whiten.log_evidence(at.whitened.col(e));
  });
  at.score = score(at.log_evidences);
  return at;
}

Quadratics HeldKernels::quadratics(const Vector& z, const At& at) const {
  const Index q = z.size(), outputs = at.targets.cols();
  const auto slopes = identification::slopes([this](const Vector& other) { return targets(other); }, z, at.targets);
  Quadratics result{at.log_evidences, Matrix(q, outputs), std::vector<Matrix>(static_cast<std::size_t>(outputs))};
  problem_.evaluator.for_each(outputs, [&](Index e) {
    Matrix jacobian(at.targets.rows(), q);
    for (Index i = 0; i < q; ++i) jacobian.col(i) = slopes[static_cast<std::size_t>(i)].col(e);
    jacobian = whitenings_[static_cast<std::size_t>(e)](jacobian);
    result.gradients.col(e) = -jacobian.transpose() * at.whitened.col(e);
    result.curvatures[static_cast<std::size_t>(e)] = jacobian.transpose() * jacobian;
  });
  return result;
}

double held_score(const FitProblem& problem, const Fit& fit) {
  if (fit.kernels.front().hyperparameters.inputs() == 0 || !problem.residuals.at(problem.prior, fit.phi).inputs)
    return -kInf;
  const HeldKernels held(problem, fit);
  return held.at(held.start()).score;
}

void climb(const FitProblem& problem, Fit& fit) {
  const HeldKernels held(problem, fit);
  Climb climb(held);
  climb.run();
  fit.phi = held.phi(climb.z());
  fit.score = climb.score();
  fit.evaluations += climb.evaluations();
}

}  // namespace rehearse::identification
