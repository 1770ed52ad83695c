#include "rehearse/study/study.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/dynamics/simulator_model.hpp"
#include "rehearse/statistics/columns.hpp"
#include "rehearse/study/mean_ratio.hpp"
#include "rehearse/study/odd_logs.hpp"

namespace rehearse::study {
namespace {

constexpr double kHorizonsS[] = {0.1, 0.5, 2};
constexpr std::size_t kMostLeftOut = 4;
constexpr std::uint64_t kSeed = 1;  // of all random numbers of a study

class Student {
 public:
  Student(const Problem& problem, const Options& options, const Evaluator& evaluator, const ProgressSink& progress)
      : problem_(problem), options_(options), evaluator_(evaluator), progress_(progress) {
    plan_.every = steps_of(options.every_s, problem.task);
    plan_.particles = options.particles;
    for (const double horizon_s : kHorizonsS) {
      const Index steps = steps_of(horizon_s, problem.task);
      if (!plan_.horizons.empty() && plan_.horizons.back() == steps) continue;
      plan_.horizons.push_back(steps);
      study_.horizons_s.push_back(seconds(steps, problem.task.dt_s));
    }
  }

  Study run() {
    logs_ = problem_.logs.size() == 1 ? halves(problem_.logs.front()) : problem_.logs;
    require_long_logs();
    require_time_for_zeros();
    leave_out();
    const Matrix ones = Matrix::Ones(std::ssize(plan_.horizons), problem_.task.state_size());
    const Matrix unknown = accuracy(study_.left_out_logs.model, ones).rms;
    widen(study_.left_out_logs.model, unknown);
    study_.calibration = calibration(study_.left_out_logs.model);
    say("all logs");
    study_.model = learned_from(problem_.logs, -1, study_.beyond);
    for (std::size_t i = 0; i < problem_.held_out.size(); ++i) {
      const PreparedLog prepared = prepared_for(study_.model, problem_.held_out[i]);
      test(problem_.held_out[i], study_.model, prepared, kMostLeftOut + i, study_.held_out);
      test_prior(problem_.held_out[i], prepared.first, kMostLeftOut + i, study_.held_out);
    }
    widen(study_.held_out.model, unknown);
    for (Tested* tested : {&study_.left_out_logs, &study_.held_out}) {
      tested->of_model = accuracy(tested->model, study_.calibration);
      tested->of_prior = accuracy(tested->prior_as_given, study_.calibration);
    }
    study_.steps = step_errors();
    if (moves(study_.model)) study_.hints = hints();
    study_.odd_log = odd_log();
    return std::move(study_);
  }

 private:
  void say(const std::string& phase) const {
    if (progress_) progress_({.phase = phase});
    evaluator_.stop_if_asked();
  }

  static std::vector<Log> halves(const Log& log) {
    const Index half = log.episode.steps() / 2;
    const auto part = [&](const std::string& name, Index first, Index steps) {
      return Log{log.name + name, log.episode.part(first, steps), log.measured.middleRows(first, steps + 1)};
    };
    return {part(" (first half)", 0, half), part(" (second half)", half, log.episode.steps() - half)};
  }

  /// Each log is left out once, so that two must be long enough to learn from.
  void require_long_logs() const {
    const Index least = zero_problem(problem_.prior, problem_.task, options_).horizon;
    std::vector<std::string> lines;
    for (const Log& log : logs_)
      if (log.episode.steps() < least) lines.push_back(too_short(log, least));
    if (logs_.size() - lines.size() < 2 && !lines.empty()) throw InvalidInput(lines);
  }

  std::string too_short(const Log& log, Index least) const {
    const Index steps = log.episode.steps(), half = steps / 2;
    std::string line = fmt::format("{}: {} control steps, must be at least the {} that parameters are fitted to",
                                   log.name, steps, least);
    if (half > 0) line += fmt::format(" (--set fit_horizon_s={:.2g} would do)", seconds(half, problem_.task.dt_s));
    return line;
  }

  /// Logs that are left out or held out have their zeros estimated from their first seconds, and are forecast from then
  /// on.
  void require_time_for_zeros() const {
    if (states_named(options_.zeros, problem_.task).empty()) return;
    const Index least = zero_problem(problem_.prior, problem_.task, options_).horizon;
    if (steps_of(options_.zero_s, problem_.task) < least)
      throw InvalidInput(
          fmt::format("zero_s = {}, must be at least the {:.4g} s that parameters are fitted to "
                      "(fit_horizon_s = {})",
                      options_.zero_s, seconds(least, problem_.task.dt_s), options_.fit_horizon_s));
    std::vector<std::string> lines;
    const auto check = [&](const Log& log) {
      if (steps_of(options_.zero_s, problem_.task) >= log.episode.steps())
        lines.push_back(fmt::format("{}: zero_s = {}, must be less than its {:.4g} s", log.name, options_.zero_s,
                                    seconds(log.episode.steps(), problem_.task.dt_s)));
    };
    std::for_each_n(logs_.begin(), std::min(logs_.size(), kMostLeftOut), check);
    std::ranges::for_each(problem_.held_out, check);
    if (!lines.empty()) throw InvalidInput(lines);
  }

  /// Logs forecast by models that did not learn from them.
  struct LeftOut {
    std::vector<LogModel> models;
    std::vector<PreparedLog> prepared;
    Tested tested;
    Matrix rms;
  };

  /// parameters: of the same logs, where these are known, too.
  LeftOut leave_out(Beyond beyond, const LeftOut* parameters) const {
    LeftOut left;
    if (parameters) left.prepared = parameters->prepared;
    for (std::size_t out = 0; out < std::min(logs_.size(), kMostLeftOut); ++out) {
      say(fmt::format("all but {}{}", logs_[out].name, beyond == Beyond::nothing ? "" : ", with GPs"));
      left.models.push_back(parameters ? with_beyond(parameters->models[out], beyond)
                                       : learned_from(logs_, static_cast<Index>(out), beyond));
      if (!parameters) left.prepared.push_back(prepared_for(left.models.back(), logs_[out]));
      test(logs_[out], left.models.back(), left.prepared[out], out, left.tested);
      if (!parameters) test_prior(logs_[out], left.prepared[out].first, out, left.tested);
    }
    if (parameters) left.tested.prior_as_given = parameters->tested.prior_as_given;
    const Matrix ones = Matrix::Ones(std::ssize(plan_.horizons), problem_.task.state_size());
    left.rms = accuracy(left.tested.model, ones).rms;
    return left;
  }

  /// Chooses what is learned beyond the parameters, too.
  void leave_out() {
    const bool choose = options_.beyond == Beyond::chosen;
    study_.beyond = choose ? Beyond::nothing : options_.beyond;
    LeftOut left = leave_out(study_.beyond, nullptr);
    if (choose) {
      LeftOut with = leave_out(Beyond::gp, &left);  // whose parameters are the same
      const double worse = mean_ratio(with.rms, left.rms);
      study_.gps_worsen = std::isnan(worse) ? 1 : worse;
      if (*study_.gps_worsen < 1) study_.beyond = Beyond::gp, left = std::move(with);
    }
    study_.without = std::move(left.models);
    study_.left_out_logs = std::move(left.tested);
  }

  /// out: −1: none is left out.
  LogModel learned_from(const std::vector<Log>& logs, Index out, Beyond beyond) const {
    std::vector<Episode> episodes;
    for (std::size_t i = 0; i < logs.size(); ++i)
      if (static_cast<Index>(i) != out) episodes.push_back(logs[i].episode);
    return learn_logs(episodes, problem_.task, problem_.prior, options_with(beyond), evaluator_);
  }

  LogModel with_beyond(LogModel model, Beyond beyond) const {
    model.learned = learned_beyond(model, problem_.task, problem_.prior, options_with(beyond), evaluator_);
    return model;
  }

  Options options_with(Beyond beyond) const {
    Options options = options_;
    options.beyond = beyond;
    return options;
  }

  PreparedLog prepared_for(const LogModel& model, const Log& log) const {
    return prepare(log.episode, model, problem_.task, problem_.prior, options_, evaluator_);
  }

  std::vector<Hint> hints() const {
    say("zeros and delays");
    std::vector<Episode> episodes;
    for (const Log& log : problem_.logs) episodes.push_back(log.episode);
    return find_hints(episodes, problem_.task, problem_.prior, options_, evaluator_);
  }

  std::string odd_log() const {
    std::vector<double> left;
    for (std::size_t i = 0; i < study_.without.size(); ++i)
      left.push_back(unexplained(study_.left_out_logs.model[i], logs_[i].measured));
    const auto odd = study::odd_log(left);
    if (!odd) return "";
    const double of_odd = std::exchange(left[*odd], 0);
    for (double& of : left)
      if (!std::isfinite(of)) of = 0;  // of a log that never changes nothing is known
    return fmt::format(
        "{}: what the other logs teach leaves {:.0f} % of its changes unexplained, and at most {:.0f} % of theirs: is "
        "it "
        "of another robot, or has a column another sign or unit?",
        logs_[*odd].name, 100 * of_odd, 100 * std::ranges::max(left));
  }

  void test(const Log& log, const LogModel& model, const PreparedLog& prepared, std::size_t number,
            Tested& tested) const {
    ForecastPlan plan = plan_;
    plan.first = prepared.first;
    plan.start_std = prepared.offset_std;
    tested.logs.push_back(log.name);
    tested.offsets.push_back(prepared.offset);
    tested.model.push_back(make_forecasts(*model.learned.model, prepared.log,
                                          log.measured.rowwise() + prepared.offset.transpose(), plan, draws(number)));
  }

  void test_prior(const Log& log, Index first, std::size_t number, Tested& tested) const {
    ForecastPlan plan = plan_;
    plan.first = first;
    const dynamics::SimulatorModel given(problem_.prior, problem_.prior.space.values());
    tested.prior_as_given.push_back(make_forecasts(given, log.episode, log.measured, plan, draws(number)));
  }

  Draws draws(std::size_t number) const {
    return {{.seed = kSeed, .trial = number, .stage = Stage::prediction}, evaluator_};
  }

  /// The model of all logs, with GPs even where forecasts are better without.
  LogModel with_gps() const {
    if (study_.beyond != Beyond::nothing || options_.beyond != Beyond::chosen) return study_.model;
    return with_beyond(study_.model, Beyond::gp);
  }

  StepErrors step_errors() const {
    const Dataset& data = study_.model.data;
    const auto left = [&](const dynamics::DynamicsModel& model) -> Vector {
      Matrix mean(data.states.rows(), data.states.cols());
      model.predict_mean(data.states, data.actions, mean);
      return statistics::column_root_mean_squares(data.changes - mean);
    };
    const prior::Prior& prior = problem_.prior;
    return {statistics::column_root_mean_squares(data.changes),
            left(dynamics::SimulatorModel(prior, prior.space.values())),
            left(dynamics::SimulatorModel(prior, *study_.model.learned.state.phi)), left(*with_gps().learned.model)};
  }

  const Problem& problem_;
  const Options& options_;
  const Evaluator& evaluator_;
  const ProgressSink& progress_;
  ForecastPlan plan_;
  std::vector<Log> logs_;
  Study study_;
};

}  // namespace

Study study_logs(const Problem& problem, const Options& options, const Evaluator& evaluator,
                 const ProgressSink& progress) {
  if (problem.logs.empty()) throw InvalidInput("there is no log to learn from");
  return Student(problem, options, evaluator, progress).run();
}

}  // namespace rehearse::study
