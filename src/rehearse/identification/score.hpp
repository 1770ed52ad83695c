#pragma once

#include "rehearse/core/types.hpp"

namespace rehearse::identification {

/// The combination of the outputs' likelihoods into one score of a φ (Chatzilygeroudis 2018, section IV-B).
enum class Score { sum, product, harmonic };

/// log of the sum (product, harmonic mean) of likelihoods given as log likelihoods, without over- or underflow.
double score_of(const Vector& log_likelihoods, Score score);

/// Its gradient with respect to the log likelihoods, which must be finite: each ≥ 0.
Vector score_gradient(const Vector& log_likelihoods, Score score);

}  // namespace rehearse::identification
