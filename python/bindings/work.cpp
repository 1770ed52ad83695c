#include "python/bindings/work.hpp"

#include <pybind11/stl.h>

#include "apps/cli/cache.hpp"
#include "rehearse/core/processor.hpp"
#include "rehearse/experiment/tables.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::python {
namespace {

/// Tells a function of Python, on the thread that runs the work.
class Listener final : public experiment::RunListener {
 public:
  explicit Listener(const Callable& function) : function_(function) {}

  void started(const experiment::Resolved& resolved, const std::filesystem::path& folder, Index done) override {
    names_ = experiment::tunable_names(resolved.prior);
    tell([&] {
      const experiment::Spec& spec = resolved.spec;
      return py::dict(py::arg("kind") = "started", py::arg("folder") = folder.string(),
                      py::arg("robot") = spec.scenario, py::arg("learner") = spec.learner,
                      py::arg("prior") = spec.prior, py::arg("seed") = spec.seed, py::arg("trials") = spec.trials,
                      py::arg("done") = done);
    });
  }

  void progress(Index trial, const Progress& progress) override {
    if (throttle_.passes()) tell([&] { return progress_of(trial, progress); });
  }

  void trial_done(const experiment::TrialRecord& record) override {
    tell([&] {
      py::dict event = trial_of(record, names_);
      event["kind"] = "trial";
      return event;
    });
  }

 private:
  template <class Event>
  void tell(Event event) {
    try {
      call_between(function_, [&](const py::object& function) { function(event()); });
    } catch (const system::Unavailable&) {
      throw Interrupted();  // the exception is kept, and the run can be resumed
    }
  }

  Callable function_;
  std::vector<std::string> names_;
  Throttle throttle_;
};

}  // namespace

void warn(const std::vector<std::string>& lines) {
  const py::gil_scoped_acquire locked;
  for (const std::string& line : lines)
    if (PyErr_WarnEx(PyExc_UserWarning, line.c_str(), 2) != 0) throw py::error_already_set();
}

void work_with(const Robot& robot, const Settings& settings, const Work& work) {
  require_processor();
  require_outside_of_robots();
  const Robot own = robot.for_work();
  Listener listener({shared(settings.listener), "progress", own.failure()});
  const bool heard = !settings.listener.is_none();
  do_unlocked(own.failure(), [&](const std::function<bool()>& stop) {
    work(own, {.evaluator = make_thread_evaluator(settings.threads),
               .listener = heard ? &listener : nullptr,
               .stop = stop,
               .cache = apps::cache_folder});
  });
}

py::dict progress_of(Index trial, const Progress& progress) {
  return py::dict(py::arg("kind") = "progress", py::arg("trial") = trial, py::arg("phase") = progress.phase,
                  py::arg("done") = progress.done, py::arg("best") = progress.best,
                  py::arg("rollouts") = progress.rollouts, py::arg("rollouts_per_s") = progress.rollouts_per_s);
}

py::dict trial_of(const experiment::TrialRecord& trial, const std::vector<std::string>& parameters) {
  py::dict phi, intervals;
  for (std::size_t i = 0; i < std::min(parameters.size(), trial.phi.size()); ++i) {
    phi[py::str(parameters[i])] = trial.phi[i];
    if (i < trial.phi_intervals.size() && trial.phi_intervals[i])
      intervals[py::str(parameters[i])] = py::make_tuple(trial.phi_intervals[i]->low, trial.phi_intervals[i]->high);
  }
  py::list limits;
  for (const experiment::LimitRecord& limit : trial.limits)
    limits.append(py::dict(py::arg("name") = limit.limit, py::arg("allowed") = limit.allowed,
                           py::arg("risk") = limit.predicted, py::arg("low") = limit.interval.low,
                           py::arg("high") = limit.interval.high, py::arg("broken") = limit.broken));
  return py::dict(py::arg("trial") = trial.trial, py::arg("total_reward") = trial.total_reward,
                  py::arg("predicted_return") = trial.predicted_return, py::arg("solved") = trial.solved,
                  py::arg("cut_short") = trial.cut_short, py::arg("phi") = phi, py::arg("intervals") = intervals,
                  py::arg("limits") = limits, py::arg("warnings") = trial.warnings, py::arg("notes") = trial.notes);
}

}  // namespace rehearse::python
