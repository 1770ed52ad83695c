#pragma once

#include "rehearse/expression/tape.hpp"

namespace rehearse::expression {

/// An operation on single numbers, by the C library: for constants, and where there is no vectorised function.
double evaluate(Op op, double a, double b, double c);

}  // namespace rehearse::expression
