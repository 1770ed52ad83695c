#include "rehearse/learners/pilco/model.hpp"

#include <limits>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/gp/posterior.hpp"
#include "rehearse/moments/fitc.hpp"
#include "rehearse/moments/network_prior.hpp"
#include "rehearse/moments/requirements.hpp"
#include "rehearse/optim/cautious_bfgs.hpp"

namespace rehearse::learners::pilco {
namespace {

/// Inducing inputs for GPs of Y at X: rows spread evenly, then moved to where the sum of the outputs' evidence is
/// higher, in units of the inputs' spread.
Matrix inducing_inputs(const gp::Inputs& inputs, const Matrix& X, const Matrix& Y, const ModelProblem& problem,
                       const std::vector<gp::Hyperparameters>& kernels) {
  const ModelOptions& options = problem.options;
  const Index m = options.inducing, D = X.cols();
  Matrix Z(m, D);
  for (Index i = 0; i < m; ++i) Z.row(i) = X.row(i * X.rows() / m);
  if (options.inducing_line_searches == 0) return Z;
  const auto spread = inputs.spread().asDiagonal();
  const auto evidence = [&](const Vector& z, Vector& gradient) {
    if (problem.progress) problem.progress({.phase = "inducing inputs"});
    const Matrix at = z.reshaped(m, D) * spread;
    std::vector<Matrix> gradients(kernels.size());
    Vector values(Y.cols());
    problem.evaluator.for_each(Y.cols(), [&](Index e) {
      const auto output = static_cast<std::size_t>(e);
      values(e) = moments::fitc_evidence(X, Y.col(e), at, kernels[output], &gradients[output]);
    });
    Matrix sum = Matrix::Zero(m, D);
    for (const Matrix& each : gradients) sum += each;
    gradient = (sum * spread).reshaped();
    return values.sum();
  };
  const Vector start = (Z * inputs.spread().cwiseInverse().asDiagonal()).reshaped();
  const optim::GradientResult found =
      optim::maximise_cautious_bfgs(evidence, start, {.line_searches = options.inducing_line_searches});
  return found.x.reshaped(m, D) * spread;
}

std::vector<moments::MomentTerm> terms(const Matrix& X, const Matrix& Y, const ModelProblem& problem,
                                       const std::vector<gp::Hyperparameters>& kernels,
                                       std::vector<std::string>& notes) {
  const gp::Inputs inputs(X);
  if (X.rows() > problem.options.inducing) {
    try {
      return moments::fitc_terms(X, Y, inducing_inputs(inputs, X, Y, problem, kernels), kernels);
    } catch (const InvalidInput& error) {
      notes.push_back(fmt::format("all rows are used instead of inducing inputs: {}", error.what()));
    }
  }
  return moments::exact_terms(gp::Posterior(inputs, Y, kernels));
}

std::shared_ptr<const moments::MomentMatching> around(const std::vector<moments::MomentTerm>& mean,
                                                      std::vector<moments::MomentTerm> terms, Index outputs) {
  terms.insert(terms.end(), mean.begin(), mean.end());
  return std::make_shared<moments::MomentMatching>(std::move(terms), outputs);
}

identification::Kind kind(const ModelOptions& options, bool around_a_mean) {
  const auto adapt = [&](auto kind) {  // each state has a GP of its own, whose moments are known
    static_cast<dynamics::GpOptions&>(kind.gp) = {};
    kind.gp.fit = options.fit;
    kind.gp.smooth = options.smooth;
    if constexpr (requires { kind.gp.midpoint; }) kind.gp.midpoint = false;
    return identification::Kind(kind);
  };
  return around_a_mean ? adapt(identification::FixedPrior{}) : adapt(identification::ZeroMean{});
}

}  // namespace

void ModelOptions::fields(FieldVisitor& v) {
  v.publish("fit.method", {});  // PILCO's, too, goes along conjugate gradients or BFGS
  v.publish("fit.starts", published(1, "PILCO"));
  v.publish("fit.part_rows", published(0, "PILCO"));
  v.group("fit", fit, kExpert);
  v.boolean("joint_angles", joint_angles, "GPs see the angles between links, too, where the task names them",
            published(false, "PILCO"));
  v.boolean("smooth", smooth, "noisy states are smoothed where that makes what was measured likelier",
            published(false, "PILCO"));
  v.integer("inducing", inducing, "more rows than so many are summed up by so many inducing inputs", between(1, 1e5),
            published(300, "PILCO"));
  v.integer("inducing_line_searches", inducing_line_searches, "line searches that place the inducing inputs",
            at_least(0), published(500, "PILCO"));
}

Model learn(const ModelProblem& problem, const std::vector<gp::Hyperparameters>& start,
            const std::vector<moments::MomentTerm>& mean) {
  const auto& [task, data, options, evaluator, progress] = problem;
  Model model{.kernels = start, .log_evidence = std::numeric_limits<double>::quiet_NaN()};
  const FeatureMap features = moments::model_features(task, options.joint_angles);
  std::optional<prior::Prior> prior;
  if (!mean.empty()) prior = moments::network_prior("network", features, mean);
  try {
    const Kinematics none{.dt_s = task.dt_s};  // neither integrals of rates nor servos, which have no moments
    identification::Learned learned = identification::learn({data, features, none, prior ? &*prior : nullptr},
                                                            kind(options, !mean.empty()), {start, {}}, evaluator);
    model.notes = std::move(learned.notes);
    const Dataset& rows = learned.smoothed ? learned.smoothed->data : data;
    const auto& kernels = learned.smoothed ? learned.smoothed->kernels : learned.state.kernels;
    const Matrix X = dynamics::gp_inputs(features, rows.states, rows.actions);
    Matrix Y = rows.changes;
    if (!mean.empty()) Y -= moments::evaluate_means(mean, Y.cols(), X);
    model.moments = around(mean, terms(X, Y, problem, kernels, model.notes), task.state_size());
    model.moments_of_all_rows = [X, Y, mean, kernels] {
      return around(mean, moments::exact_terms(gp::Posterior(gp::Inputs(X), Y, kernels)), Y.cols());
    };
    model.model = std::move(learned.model);
    model.kernels = std::move(learned.state.kernels);
    model.log_evidence = *learned.log_evidence;
  } catch (const InvalidInput& nothing_to_learn_from) {
    model.notes.push_back(fmt::format("no model, so the policy stays: {}", nothing_to_learn_from.what()));
  }
  return model;
}

std::vector<moments::MomentTerm> terms_of(const ModelProblem& problem, const std::vector<gp::Hyperparameters>& kernels,
                                          std::vector<std::string>& notes) {
  const FeatureMap features = moments::model_features(problem.task, problem.options.joint_angles);
  const Matrix X = dynamics::gp_inputs(features, problem.data.states, problem.data.actions);
  return terms(X, problem.data.changes, problem, kernels, notes);
}

}  // namespace rehearse::learners::pilco
