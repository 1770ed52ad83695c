#include "rehearse/core/turns.hpp"

#include <algorithm>
#include <cmath>

namespace rehearse {

bool within_one_turn(double low, double high) {
  constexpr double kLittle = 1e-6;  // the bounds in single precision are up to 2e-7 beyond
  const auto within = [&](double from) { return low >= from - kLittle && high <= from + kTurn + kLittle; };
  return within(-std::numbers::pi) || within(0);
}

double turns_towards(double other, double angle) { return std::nearbyint((other - angle) / kTurn); }

void TurnCounter::begin() { last_.reset(); }

double TurnCounter::counted(double given) {
  const double last = last_.value_or(given), jump = given - last;
  const bool within = within_one_turn(std::min(last, given), std::max(last, given));
  if (!last_) turns_ = within ? turns_towards(start_, given) : 0;
  if (within && std::abs(jump) > std::numbers::pi) turns_ -= std::copysign(1, jump);
  last_ = given;
  return given + kTurn * turns_;
}

Turns::Turns(const std::vector<Index>& angles, const Vector& starts) : angles_(angles) {
  for (const Index angle : angles) counters_.emplace_back(starts(angle));
}

void Turns::begin() {
  for (TurnCounter& counter : counters_) counter.begin();
}

Vector Turns::counted(Vector given) {
  for (std::size_t i = 0; i < angles_.size(); ++i) given(angles_[i]) = counters_[i].counted(given(angles_[i]));
  return given;
}

Vector Turns::beside(Vector truth, const Vector& measured) const {
  if (truth.size() != measured.size()) return truth;
  for (const Index angle : angles_) truth(angle) += kTurn * turns_towards(measured(angle), truth(angle));
  return truth;
}

}  // namespace rehearse
