#include "python/bindings/campaign.hpp"

#include <chrono>
#include <future>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "apps/cli/cache.hpp"
#include "python/bindings/work.hpp"
#include "rehearse/campaign/campaign.hpp"
#include "rehearse/campaign/planner.hpp"
#include "rehearse/campaign/robot_of.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/core/processor.hpp"
#include "rehearse/experiment/resolve.hpp"
#include "rehearse/system/simulator.hpp"

namespace rehearse::python {
namespace {

using campaign::CampaignPlan, campaign::RunState;

/// A campaign that is to be done, or gone on with.
struct CampaignRequest {
  std::string text, source;  // of its file
  std::string scenario;      // of the robot that Python gives; empty: the file says which
  std::string out;
  campaign::Share share;
};

campaign::Share share_of(const std::string& text) {
  if (const auto share = campaign::read_share(text)) return *share;
  throw InvalidInput(fmt::format("share = '{}', must be 'K/N' with K from 1 to N", text));
}

/// Tells a function of Python. What it raises is kept, and stops the campaign where that can be continued.
class CampaignTeller final : public campaign::CampaignListener {
 public:
  explicit CampaignTeller(const Callable& function) : function_(function) {}

  void started(const campaign::Campaign& begun, Index /*at_once*/) override {
    plan_ = begun.plan;
    ended_ = begun.count(RunState::done) + begun.count(RunState::failed);
    tell([&] {
      return py::dict(py::arg("kind") = "campaign", py::arg("title") = plan_.title, py::arg("robot") = plan_.scenario,
                      py::arg("trials") = plan_.trials, py::arg("runs") = plan_.runs.size(), py::arg("ended") = ended_,
                      py::arg("notes") = begun.remarks());
    });
  }

  void progress(std::size_t run, Index trial, const Progress& progress) override {
    if (!throttle_.passes()) return;
    tell([&] {
      py::dict event = progress_of(trial, progress);
      event["run"] = plan_.runs[run].name;
      return event;
    });
  }

  void run_ended(std::size_t run, const campaign::RunOutcome& outcome) override {
    ++ended_;
    const campaign::PlannedRun& planned = plan_.runs[run];
    const campaign::CampaignGroup& group = plan_.groups[planned.group];
    const bool failed = outcome.state == RunState::failed;
    tell([&] {
      return py::dict(
          py::arg("kind") = "run", py::arg("run") = planned.name, py::arg("learner") = group.learner,
          py::arg("prior") = group.prior, py::arg("variant") = group.variant, py::arg("seed") = planned.spec.seed,
          py::arg("failed") = failed ? std::optional(outcome.reason) : std::nullopt, py::arg("trials") = outcome.done(),
          py::arg("first_success") = outcome.first_success(plan_.trials),
          py::arg("best_return") = outcome.done() > 0 ? std::optional(outcome.best_return(plan_.trials)) : std::nullopt,
          py::arg("ended") = ended_, py::arg("runs") = plan_.runs.size());
    });
  }

 private:
  template <class Event>
  void tell(Event event) {
    if (function_.failure->any()) return;
    try {
      call_between(function_, [&](const py::object& function) { function(event()); });
    } catch (const system::Unavailable&) {  // the exception is kept
    }
  }

  Callable function_;
  CampaignPlan plan_;
  Index ended_ = 0;
  Throttle throttle_;
};

/// Refuses a file about another robot than the one that is given, and calls its functions once, before there is a
/// folder.
void try_out_campaign(const Robot& robot, const experiment::Catalogue& catalogue, const CampaignRequest& request) {
  const CampaignPlan plan = campaign::plan_campaign(catalogue, request.text, request.source);
  if (plan.scenario != request.scenario)
    throw InvalidInput(fmt::format("{}: scenario = '{}', but the robot that is given is '{}'", request.source,
                                   plan.scenario, request.scenario));
  if (!plan.runs.empty()) robot.try_out(experiment::resolve(catalogue, plan.runs.front().spec).scenario);
}

/// Does the work in a thread of its own. Python tells only the thread that calls of Ctrl-C, so that one must be free.
campaign::Campaign watched(const std::function<bool()>& stop, const std::function<campaign::Campaign()>& work) {
  auto done = std::async(std::launch::async, [&] {
    const py::gil_scoped_acquire kept;  // Python's state of this thread: made anew, it costs each call 10 µs
    const py::gil_scoped_release unlocked;
    return work();
  });
  while (done.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) stop();
  return done.get();
}

void do_campaign(const Robot& robot, const CampaignRequest& request, const Settings& settings) {
  require_processor();
  require_outside_of_robots();
  const Robot own = robot.for_work();
  CampaignTeller teller({shared(settings.listener), "progress", own.failure()});
  const bool heard = !settings.listener.is_none();
  do_unlocked(own.failure(), [&](const std::function<bool()>& stop) {
    const bool given = !request.scenario.empty();
    const experiment::Catalogue catalogue =
        given ? own.catalogue() : campaign::with_robot_of(own.catalogue(), request.text, request.source);
    if (given) try_out_campaign(own, catalogue, request);
    const campaign::Campaign done = watched(stop, [&] {
      return campaign::run_campaign(catalogue, request.text, request.source, request.out,
                                    {.threads = settings.threads,
                                     .listener = heard ? &teller : nullptr,
                                     .stop = stop,
                                     .share = request.share,
                                     .cache = apps::cache_folder});
    });
    if (done.count(RunState::unfinished) > 0) throw Interrupted();
  });
}

}  // namespace

void add_campaign(py::module_& module) {
  using namespace py::literals;
  module.def(
      "campaign",
      [](const Robot& robot, const std::string& text, const std::string& source, const std::string& scenario,
         const std::string& out, const std::string& share, int threads, py::object listener) {
        do_campaign(robot, {text, source, scenario, out, share_of(share)}, {threads, std::move(listener)});
      },
      "robot"_a, "text"_a, "source"_a, "scenario"_a, "out"_a, "share"_a, "threads"_a, "listener"_a);
}

}  // namespace rehearse::python
