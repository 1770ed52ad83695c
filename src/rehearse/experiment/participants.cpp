#include "rehearse/experiment/participants.hpp"

namespace rehearse::experiment {

std::shared_ptr<const Evaluator> evaluator_of(const RunOptions& options) {
  auto evaluator = options.evaluator ? options.evaluator
                                     : std::shared_ptr<const Evaluator>(&serial_evaluator(), [](const Evaluator*) {});
  return options.stop ? make_stoppable(std::move(evaluator), options.stop) : evaluator;
}

Participants::Participants(Resolved resolved, const RunOptions& options)
    : options_(options),
      evaluator_(evaluator_of(options)),
      resolved_(std::move(resolved)),
      store_(std::make_shared<RunStore>(resolved_.spec, options.cache)),
      learner_(resolved_.learner->build(setting())) {}

system::Plant& Participants::plant() {
  if (!plant_) plant_ = resolved_.scenario.make_plant();
  return *plant_;
}

learners::Setting Participants::setting() {
  return {.task = task(),
          .policy = resolved_.scenario.policy,
          .prior = resolved_.prior,
          .start = start_of(resolved_.spec.start),
          .seed = static_cast<std::uint64_t>(resolved_.spec.seed),
          .evaluator = evaluator_,
          .progress = [this](const Progress& progress) { report(progress); },
          .store = store_};
}

void Participants::report(const Progress& progress) const {
  evaluator_->stop_if_asked();
  if (options_.listener) options_.listener->progress(trial_, progress);
}

}  // namespace rehearse::experiment
