#include "rehearse/cli/cli.hpp"

//: docs/own-robot.md class Arm

Task task() { return {}; }
void change(const ConstMatrixView&, const ConstMatrixView&, const Vector&, MatrixView) {}
Vector Arm::reset(Rng&) { return {}; }
Vector Arm::step(const Vector&) { return {}; }

constexpr auto cart = arm;
//: docs/own-robot.md int main
