#include "python/bindings/evaluation.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include "python/bindings/work.hpp"
#include "rehearse/experiment/participants.hpp"
#include "rehearse/experiment/prepared_evaluation.hpp"

namespace rehearse::python {
namespace {

using experiment::EvaluationRequest, experiment::PreparedEvaluation;
using EvaluationWork = std::function<void(const PreparedEvaluation&, const Evaluator&)>;

/// Does the work with what is evaluated. Ctrl-C stops it.
void with_evaluation(const Robot& robot, const EvaluationRequest& request, int threads, const EvaluationWork& work) {
  work_with(robot, {threads}, [&](const Robot& own, const experiment::RunOptions& options) {
    work(experiment::prepare_evaluation(experiment::read_run(own.catalogue(), request.folder), request),
         *experiment::evaluator_of(options));
  });
}

py::dict evaluate(const Robot& robot, const EvaluationRequest& request, int threads) {
  std::vector<experiment::Outcome> outcomes;
  with_evaluation(robot, request, threads, [&](const auto& prepared, const auto& evaluator) {
    outcomes = experiment::evaluate(prepared, evaluator);
  });
  std::vector<double> returns;
  std::vector<std::optional<bool>> solved, solved_at_end;
  std::vector<std::optional<double>> ended_s;
  std::vector<std::vector<std::string>> broke;
  for (const experiment::Outcome& outcome : outcomes) {
    returns.push_back(outcome.total_reward);
    solved.push_back(outcome.solved);
    solved_at_end.push_back(outcome.solved_at_end);
    ended_s.push_back(outcome.ended_s);
    broke.push_back(outcome.broke);
  }
  return py::dict(py::arg("total_reward") = returns, py::arg("solved") = solved,
                  py::arg("solved_at_end") = solved_at_end, py::arg("ended_s") = ended_s, py::arg("broke") = broke);
}

/// The text of robustness.csv.
std::string robustness(const Robot& robot, const EvaluationRequest& request, int threads) {
  std::string table;
  with_evaluation(robot, request, threads, [&](const PreparedEvaluation& prepared, const Evaluator& evaluator) {
    const auto all = experiment::robustness(prepared, evaluator);
    table = experiment::robustness_csv(all, prepared.about());
    warn(experiment::robustness_failures(all));
  });
  return table;
}

}  // namespace

void add_evaluation(py::module_& module) {
  using namespace py::literals;
  py::class_<EvaluationRequest>(module, "EvaluationRequest")
      .def(py::init([](const std::string& folder, std::optional<Index> trial, const std::optional<std::string>& policy,
                       const learners::OptionTexts& settings, Index episodes, double seconds,
                       std::optional<Index> seed) {
             return EvaluationRequest{.folder = folder,
                                      .trial = trial,
                                      .policy = policy,
                                      .settings = settings,
                                      .plan = {episodes, seconds, seed.value_or(0)},
                                      .seed_of_run = !seed};
           }),
           "folder"_a, "trial"_a, "policy"_a, "settings"_a, "episodes"_a, "seconds"_a, "seed"_a);
  module.def("evaluate", &evaluate, "robot"_a, "request"_a, "threads"_a);
  module.def("robustness", &robustness, "robot"_a, "request"_a, "threads"_a);
}

}  // namespace rehearse::python
