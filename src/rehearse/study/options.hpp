#pragma once

#include <string>

#include "rehearse/core/options.hpp"
#include "rehearse/identification/kinds.hpp"

namespace rehearse::study {

/// The part that is learned beyond the parameters that predict the logs best over `fit_horizon_s`.
enum class Beyond {
  chosen,   // nothing or GPs, whichever forecasts logs left out better
  nothing,  // the prior at these parameters
  gp,       // GPs around it
  gp_mi,    // GPs and the parameters anew, by steps (Chatzilygeroudis 2018)
};

/// Bounds of times of logs.
inline Bound seconds_of_logs() { return {.low = 0, .high = 1e6, .low_open = true}; }

/// Options for learning a robot from logs alone.
struct Options {
  std::string zeros;           // states, "q1,q2"
  double zero_range = 0.3;     // of their units
  double zero_s = 3;           // of a held-out log
  double fit_horizon_s = 0.2;  // long enough that errors of the start's speeds do not count for most
  Index rows = 300;            // of the GPs; their time grows with its cube
  double every_s = 0.1;
  Index particles = 50;
  Beyond beyond = Beyond::chosen;
  identification::GpMi model;
  void fields(FieldVisitor& v) {
    v.text("zeros", zeros, "states whose zero is another in each log, with commas: encoders that count from power-on");
    v.number("zero_range", zero_range, "how far such a zero may be off, in the state's unit", above(0));
    v.number("zero_s", zero_s,
             "the first seconds of a held-out log, from which its zeros are estimated; forecasts begin then [s]",
             seconds_of_logs());
    v.number("fit_horizon_s", fit_horizon_s, expert("how far zeros and first parameters are made to predict [s]"),
             seconds_of_logs());
    v.integer("rows", rows, "control steps that the GPs learn from, evenly spread stretches of the logs", at_least(20));
    v.number("every_s", every_s, "time between starts of forecasts [s]", seconds_of_logs());
    v.integer("particles", particles, "particles of a forecast", between(2, 10000));
    v.choice("beyond", beyond, "what is learned beyond the parameters that predict best over some steps",
             {"chosen", "nothing", "gp", "gp-mi"});
    v.group("model", model);
  }
};

}  // namespace rehearse::study
