#pragma once
// Functions of the BBOB testbeds, as defined by Hansen, Finck, Ros and Auger 2009: Real-parameter black-box
// optimization benchmarking 2009, noiseless (RR-6829) and noisy (RR-6869) functions definitions. To be minimised over
// [−5, 5]^n.

#include <string>

#include "rehearse/core/random.hpp"
#include "rehearse/core/types.hpp"

namespace bbob {

using rehearse::Index;
using rehearse::Matrix;
using rehearse::Vector;

enum class Kind { sphere, ellipsoid, rastrigin, rosenbrock, rotated_ellipsoid, rotated_rastrigin, schaffers };
enum class Noise { none, gauss, uniform };

/// An instance of a function, shifted and rotated like the official one of this number; its minimum is 0.
class Function {
 public:
  /// number: 1, 2, 3, 8, 10, 15, 17, or of the noisy 101, 102, 104, 105, 107, 108, 110, 111.
  Function(int number, Index dimension, int instance);

  double operator()(const Vector& x) const;              // without noise
  double noisy(double value, rehearse::Rng& rng) const;  // the value as measured
  bool has_noise() const { return noise_ != Noise::none; }
  double official_minimum() const { return official_minimum_; }  // f_opt, which operator() leaves out

 private:
  void read(int number);

  Kind kind_ = Kind::sphere;
  Noise noise_ = Noise::none;
  double strength_ = 0;  // of the noise
  Vector optimum_, conditioning_;
  Matrix R_, Q_;  // rotations
  double official_minimum_ = 0;
};

/// Compares with the published values of the official instances 0 at the origin of 4 dimensions; returns what differs.
std::string self_check();

std::string name_of(int number);

}  // namespace bbob
