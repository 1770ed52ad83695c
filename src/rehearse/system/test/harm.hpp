#pragma once

namespace rehearse::system {

/// Actions of hostile_program, and what it does for them.
enum class Harm {
  killed = -1,
  hung = -2,
  failed = -3,
  left = -4,
  wrong_size = -5,
  no_answer = -6,
  partial = -7,
  flood = -8,
  crashed = -9,
  error = -10,
  noise = -20,   // and a right answer
  no_row = -30,  // the row has no meaning, and is answered so
};

}  // namespace rehearse::system
