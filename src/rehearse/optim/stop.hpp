#pragma once

#include <string>

namespace rehearse::optim {

/// The reason why a descent of CMA-ES ended.
enum class Stop { none, value_tolerance, step_tolerance, condition, growth, stagnation, no_effect, max_generations };
std::string to_string(Stop stop);  // in words

}  // namespace rehearse::optim
