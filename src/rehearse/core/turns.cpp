#include "rehearse/core/turns.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rehearse {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

}  // namespace

bool within_one_turn(double low, double high) {
  constexpr double kLittle = 1e-6;  // the bounds in single precision are up to 2e-7 beyond
  const auto within = [&](double from) { return low >= from - kLittle && high <= from + kTurn + kLittle; };
  return within(-std::numbers::pi) || within(0);
}

void TurnCounter::begin() { begun_ = false; }

double TurnCounter::counted(double given) {
  if (!begun_) last_ = given;
  const bool within = within_one_turn(std::min(last_, given), std::max(last_, given));
  if (!begun_) turns_ = within ? std::nearbyint((start_ - given) / kTurn) : 0;
  const double jump = given - last_;
  if (within && std::abs(jump) > std::numbers::pi) turns_ -= std::copysign(1, jump);
  begun_ = true, last_ = given;
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
  for (const Index angle : angles_) {
    const double turns = std::nearbyint((measured(angle) - truth(angle)) / kTurn);
    if (turns != 0) truth(angle) += turns * kTurn;
  }
  return truth;
}

}  // namespace rehearse
