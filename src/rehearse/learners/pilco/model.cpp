#include "rehearse/learners/pilco/model.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/dynamics/gp_model.hpp"
#include "rehearse/dynamics/residuals.hpp"
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

/// The kind of model. `adapt` sets options of the GPs: each state has one of its own, whose moments are known.
identification::Kind kind(const ModelOptions& options, const Mean& mean) {
  const auto adapt = [&](auto kind) {
    static_cast<dynamics::GpOptions&>(kind.gp) = {};
    kind.gp.fit = options.fit;
    kind.gp.smooth = options.smooth;
    return kind;
  };
  if (mean.prior && mean.identify) {
    identification::GpMi gp_mi = adapt(identification::GpMi{});
    gp_mi.gp.fit.starts = 1, gp_mi.gp.fit.part_rows = 0;  // its search tries other kernels itself
    return gp_mi;
  }
  if (mean.prior || !mean.network.empty()) return adapt(identification::FixedPrior{});
  return adapt(identification::ZeroMean{});
}

/// The training rows of moment matching.
struct Rows {
  Matrix X, Y;  // inputs, and changes less the mean
};

Rows rows_around(const Dataset& data, const FeatureMap& features, const Mean& mean, const Vector& phi) {
  Rows rows{dynamics::gp_inputs(features, data.states, data.actions), data.changes};
  if (!mean.network.empty()) rows.Y -= moments::evaluate_means(mean.network, rows.Y.cols(), rows.X);
  if (!mean.prior) return rows;
  Matrix change(rows.Y.rows(), rows.Y.cols());
  mean.prior->mean(data.states, data.actions, phi, change);
  rows.Y -= change;
  const std::vector<Index> finite = dynamics::finite_rows(rows.Y);
  if (static_cast<Index>(finite.size()) == rows.Y.rows()) return rows;
  return {rows.X(finite, Eigen::all), rows.Y(finite, Eigen::all)};
}

/// The mean of a model, and GPs around it.
class Around {
 public:
  Around(const Task& task, const Mean& mean, const Vector& phi) : network_(mean.network), states_(task.state_size()) {
    if (mean.prior) prior_ = moments::make_prior_moments(*mean.prior, phi, states_, task.action_size(), mean.through);
  }

  moments::StepDynamics operator()(std::vector<moments::MomentTerm> terms) const {
    terms.insert(terms.end(), network_.begin(), network_.end());
    return {std::make_shared<moments::MomentMatching>(std::move(terms), states_), prior_};
  }

 private:
  std::vector<moments::MomentTerm> network_;
  std::shared_ptr<const moments::PriorMoments> prior_;
  Index states_;
};

}  // namespace

void ModelOptions::fields(FieldVisitor& v) {
  v.publish("fit.method", {});  // PILCO's, too, goes along conjugate gradients or BFGS
  v.publish("fit.starts", published(1, "PILCO"));
  v.publish("fit.part_rows", published(0, "PILCO"));
  v.group("fit", fit, kExpert);
  v.boolean("joint_angles", joint_angles, "GPs see the angles between links, too, where the task names them",
            published(false, "PILCO"));
  v.boolean("smooth", smooth, "noisy states are smoothed where that raises the likelihood of the measurements",
            published(false, "PILCO"));
  v.integer("inducing", inducing, "number of inducing inputs (FITC), used when there are more rows than this",
            between(1, 1e5), published(300, "PILCO"));
  v.integer("inducing_line_searches", inducing_line_searches, "line searches that place the inducing inputs",
            at_least(0), published(500, "PILCO"));
}

Model learn(const ModelProblem& problem, const identification::WarmStart& start, const Mean& mean) {
  const auto& [task, data, options, evaluator, progress] = problem;
  Model model{.state = start, .log_evidence = kNaN};
  const FeatureMap features = moments::model_features(task, options.joint_angles);
  std::optional<prior::Prior> network;
  if (!mean.network.empty()) network = moments::network_prior("network", features, mean.network);
  try {
    const Kinematics none{.dt_s = task.dt_s};  // neither integrals of rates nor servos, which have no moments
    identification::Learned learned =
        identification::learn({data, features, none, network ? &*network : mean.prior, {}, task.state_names()},
                              kind(options, mean), start, evaluator);
    model.notes = std::move(learned.notes);
    const auto& kernels = learned.smoothed ? learned.smoothed->kernels : learned.state.kernels;
    const Vector phi = learned.state.phi.value_or(Vector());
    const Rows rows = rows_around(learned.smoothed ? learned.smoothed->data : data, features, mean, phi);
    const Around around(task, mean, phi);
    model.moments = around(terms(rows.X, rows.Y, problem, kernels, model.notes));
    model.moments_of_all_rows = [rows, around, kernels] {
      return around(moments::exact_terms(gp::Posterior(gp::Inputs(rows.X), rows.Y, kernels)));
    };
    model.model = std::move(learned.model);
    model.state = std::move(learned.state);
    model.log_evidence = *learned.log_evidence;
    model.posterior = std::move(learned.posterior);
    model.left_out_rows = learned.left_out_rows;
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
