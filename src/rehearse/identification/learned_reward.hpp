#pragma once
// The immediate reward as a GP learned from the rewards measured (Chatzilygeroudis 2018, Algorithm 1, line 4).

#include <string>
#include <vector>

#include "rehearse/core/episode.hpp"
#include "rehearse/core/feature_map.hpp"
#include "rehearse/core/options.hpp"
#include "rehearse/core/task.hpp"
#include "rehearse/gp/fit.hpp"

namespace rehearse::identification {

/// The scale on which the GP of the reward r is learned. A saturating reward is flat nearly everywhere, and a GP of it
/// does not extrapolate; its logarithm is a smooth function of the features, which does.
enum class RewardScale {
  linear,       // r itself (the authors' code)
  logarithmic,  // ln(r + floor), around the mean of the data; linear if a reward is negative
  evidence,     // the one under which the data are likelier
};

struct RewardOptions {
  bool learned = false;  // the task's reward is unknown, and learned from the rewards of trials
  RewardScale scale = RewardScale::evidence;
  double floor = 1e-8;   // of the logarithm, as a fraction of the largest reward; 0: linear
  double ceiling = 100;  // of what the logarithm predicts, in largest rewards: beyond the data it may go on for ever
  double caution = 1;    // the logarithm's mean less so many of its variances: 1 the mode of the reward, 0 its median
  gp::FitOptions fit;
  double tolerance = 0.01;                                              // as that of the dynamics (GpOptions)
  RewardOptions() { fit.penalties.length = fit.penalties.snr = true; }  // the authors' code
  void fields(FieldVisitor& v) {
    v.boolean("learned", learned, "the reward function is learned from the rewards of trials");
    v.choice("scale", scale, "scale of the reward's GP: linear, logarithmic, or the one of higher evidence",
             {"linear", "logarithmic", "evidence"}, published("linear", kAuthors));
    v.number("floor", floor, expert("added to rewards before the logarithm, as a fraction of the largest; 0: linear"),
             between(0, 1));
    v.number("ceiling", ceiling, expert("predicted reward at most, in largest rewards seen"), at_least(1));
    v.number("caution", caution,
             expert("predictive variances subtracted from the mean log reward; 1: mode of the reward, 0: median"),
             at_least(0));
    v.group("fit", fit, kExpert);
    v.number(
        "tolerance", tolerance,
        expert("largest error of approximate predictions, as a fraction of the noise's standard deviation; 0: exact"),
        between(0, 1), published(0));
  }
};

struct LearnedReward {
  Reward reward;  // the posterior mean (of the logarithm); any thread, no allocation after a thread's first call
  RewardScale scale = RewardScale::linear;  // chosen
  double log_evidence = 0;                  // of the rewards, nats
  std::vector<std::string> notes;           // on rows that were left out
};

/// A GP with zero mean from (features of the state reached, action) to the reward of a step, as in the authors' code.
/// Rows whose reward is not finite are left out. Throws InvalidInput if none is left, or if no kernel can
/// be fitted.
LearnedReward learn_reward(const Dataset& data, const FeatureMap& features, const RewardOptions& options);

}  // namespace rehearse::identification
