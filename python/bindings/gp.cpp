#include <memory>

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "python/bindings/calls.hpp"
#include "python/bindings/interruption.hpp"
#include "python/bindings/options.hpp"
#include "python/bindings/pieces.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/evaluator.hpp"
#include "rehearse/core/processor.hpp"
#include "rehearse/gp/fit.hpp"
#include "rehearse/gp/posterior.hpp"
#include "rehearse/moments/moment_matching.hpp"

namespace rehearse::python {
namespace {

using MatrixIn = Eigen::Ref<const Matrix, 0, Eigen::OuterStride<>>;

/// GPs that were fitted; their hyperparameters by output.
struct Fitted {
  gp::Posterior posterior;
  Vector log_evidence;
};

void require_outputs(const MatrixIn& Y) {
  if (Y.cols() == 0) throw InvalidInput("y has no columns, must have one an output");
}

std::shared_ptr<Fitted> fitted(const gp::Inputs& inputs, const MatrixIn& Y,
                               const std::vector<gp::Hyperparameters>& kernels, double tolerance) {
  gp::Posterior posterior(inputs, Y, kernels, tolerance);
  const Vector evidence = posterior.log_evidences();
  return std::make_shared<Fitted>(Fitted{std::move(posterior), evidence});
}

/// Outputs are fitted one by one on the evaluator's threads.
std::shared_ptr<Fitted> fit_outputs(const MatrixIn& X, const MatrixIn& Y, double tolerance, gp::FitOptions options,
                                    const Evaluator& evaluator) {
  require_processor();
  options.before_each = [&] { evaluator.stop_if_asked(); };
  const gp::Inputs inputs(X);
  std::vector<gp::Hyperparameters> kernels(static_cast<std::size_t>(Y.cols()));
  evaluator.for_each(Y.cols(), [&](Index e) {
    const Vector y = Y.col(e);
    const double scale = gp::usable_scale(gp::standard_deviation(y));
    const auto start = gp::default_start(inputs, y, scale, options.bounds, options.trend);
    kernels[static_cast<std::size_t>(e)] = gp::fit(inputs, y, scale, start, options).hyperparameters;
  });
  return fitted(inputs, Y, kernels, tolerance);
}

std::shared_ptr<Fitted> fit(const MatrixIn& X, const MatrixIn& Y, bool trend, double tolerance,
                            const OptionTexts& texts, int threads) {
  gp::FitOptions options;
  set_options([&](FieldVisitor& v) { options.fields(v); }, texts, {"trend", "tolerance", "threads"});
  options.trend = trend;
  require_outputs(Y);
  if (X.rows() != Y.rows()) throw InvalidInput(fmt::format("X has {} rows and y {}", X.rows(), Y.rows()));
  std::shared_ptr<Fitted> gp;
  do_unlocked(std::make_shared<Failure>(), [&](const std::function<bool()>& stop) {
    gp = fit_outputs(X, Y, tolerance, options, *make_stoppable(make_thread_evaluator(threads), stop));
  });
  return gp;
}

std::shared_ptr<Fitted> condition(const MatrixIn& X, const MatrixIn& Y, const MatrixIn& log_hyperparameters,
                                  double tolerance) {
  require_outputs(Y);
  if (log_hyperparameters.rows() != Y.cols())
    throw InvalidInput(
        fmt::format("hyperparameters has {} rows, must have one an output, {}", log_hyperparameters.rows(), Y.cols()));
  const Unlocked unlocked;
  require_processor();
  std::vector<gp::Hyperparameters> kernels;
  for (Index e = 0; e < Y.cols(); ++e)
    kernels.push_back(gp::Hyperparameters::from_flat(Vector(log_hyperparameters.row(e)), X.cols()));
  return fitted(gp::Inputs(X), Y, kernels, tolerance);
}

py::tuple predict(const Fitted& gp, const MatrixIn& X) {
  if (X.cols() != gp.posterior.dimensions())
    throw InvalidInput(fmt::format("X has {} columns, must have {}", X.cols(), gp.posterior.dimensions()));
  Matrix mean(X.rows(), gp.posterior.outputs()), variance(X.rows(), gp.posterior.outputs());
  {
    const Unlocked unlocked;
    gp.posterior.predict(X, mean, variance);
  }
  return py::make_tuple(std::move(mean), std::move(variance));
}

Matrix predict_mean(const Fitted& gp, const MatrixIn& X) {
  if (X.cols() != gp.posterior.dimensions())
    throw InvalidInput(fmt::format("X has {} columns, must have {}", X.cols(), gp.posterior.dimensions()));
  Matrix mean(X.rows(), gp.posterior.outputs());
  const Unlocked unlocked;
  gp.posterior.predict_mean(X, mean);
  return mean;
}

Matrix log_hyperparameters(const Fitted& gp) {
  const auto& all = gp.posterior.hyperparameters();
  Matrix rows(static_cast<Index>(all.size()), all.front().flat().size());
  for (Index e = 0; e < rows.rows(); ++e) rows.row(e) = all[static_cast<std::size_t>(e)].flat();
  return rows;
}

py::tuple match_moments(const Fitted& gp, const Vector& mean, const Matrix& covariance) {
  for (Index e = 0; e < gp.posterior.outputs(); ++e)
    if (gp.posterior.variance_points(e) < gp.posterior.size())
      throw InvalidInput("moments take all points, and some were left out: tolerance must be 0");
  moments::Transformed result;
  {
    const Unlocked unlocked;
    const moments::MomentMatching matching(moments::exact_terms(gp.posterior), gp.posterior.outputs());
    moments::MomentTape tape;
    if (!matching.forward({mean, covariance}, tape, result))
      throw InvalidInput(
          "mean and covariance are no Gaussian: numbers that are not finite, or a covariance that is "
          "not positive semi-definite");
  }
  return py::make_tuple(result.mean, result.covariance, Matrix(covariance * result.gain));
}

}  // namespace

void add_gp(py::module_& module) {
  using namespace py::literals;
  py::class_<Fitted, std::shared_ptr<Fitted>>(module, "FittedGp")
      .def("predict", &predict, "X"_a)
      .def("predict_mean", &predict_mean, "X"_a)
      .def("match_moments", &match_moments, "mean"_a, "covariance"_a)
      .def_property_readonly("log_hyperparameters", &log_hyperparameters)
      .def_property_readonly("log_evidence", [](const Fitted& gp) { return gp.log_evidence; })
      .def_property_readonly("jitters", [](const Fitted& gp) { return gp.posterior.jitters(); });
  module.def("fit_gp", &fit, "X"_a, "Y"_a, "trend"_a, "tolerance"_a, "options"_a, "threads"_a);
  module.def("condition_gp", &condition, "X"_a, "Y"_a, "log_hyperparameters"_a, "tolerance"_a);
}

}  // namespace rehearse::python
