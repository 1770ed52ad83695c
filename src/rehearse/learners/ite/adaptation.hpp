#pragma once

#include <string>
#include <vector>

#include "rehearse/core/options.hpp"
#include "rehearse/core/types.hpp"

namespace rehearse::learners::ite {

/// Numbers of the authors' code (Cully 2015); descriptors in units of their bounds, performances of the archive's best.
struct AdaptationOptions {
  double length = 0.4;            // ρ
  double signal_variance = 1;     // σ_f²
  double noise_variance = 0.001;  // of an observed performance
  double kappa = 0.05;            // of the upper confidence bound
  double stop_ratio = 0.9;  // stop once the best observed ≥ so much of the largest predicted, where that is above
                            // 0; 0: never
  Index max_trials = 20;    // or after so many
  void fields(FieldVisitor& v);
};

/// Map-based Bayesian optimisation (Cully 2015, methods): a Matérn-5/2 GP over descriptors, whose mean function is the
/// archive's performance, predicts the performance on the robot. A value.
class Adaptation {
 public:
  /// descriptors: D × n, one elite a column; promised: n performances. n ≥ 1, all finite.
  Adaptation(Matrix descriptors, Vector promised, AdaptationOptions options);

  Index trials() const { return static_cast<Index>(tried_.size()); }

  /// The elite of the highest upper confidence bound, mean + κ · standard deviation; of several the first.
  Index next() const;

  /// Takes the performance that an elite had on the robot. Ignored once stopped.
  void observe(Index elite, double performance);

  /// The reason to stop; empty: there is more to try.
  const std::string& stopped() const { return stopped_; }
  const Vector& means() const { return means_; }            // n, expected performances
  const Vector& deviations() const { return deviations_; }  // n, their standard deviations, without noise

 private:
  Vector covariances(Index elite) const;
  void condition();
  void judge();

  Matrix descriptors_;
  Vector promised_;
  AdaptationOptions options_;
  std::vector<Index> tried_;
  std::vector<double> observed_;
  std::vector<Vector> covariances_;  // of each trial's elite with all n
  Vector means_, deviations_;
  std::string stopped_;
};

}  // namespace rehearse::learners::ite
