#pragma once
// The command line of Rehearse for a program of your own. Link rehearse::cli.
//
//   int main(int argc, char** argv) { return rehearse::cli(argc, argv, {cart}); }
//
// learns, resumes, reports, lists and does campaigns as `rehearse` does, with the robot that cart() makes among the
// built-in ones. `rehearse` itself does not know that robot, so its runs are resumed by the same program.

#include <functional>
#include <memory>
#include <vector>

#include "rehearse/learners/learner.hpp"
#include "rehearse/scenario/scenario.hpp"

// The folder of the page of reports. An installed rehearse::cli defines it.
#ifndef REHEARSE_SHARE
#define REHEARSE_SHARE ""
#endif

namespace rehearse {

/// Makes a robot; scenario/ode_builder.hpp and scenario/builder.hpp have builders. Each call makes a new one, since its
/// options can be set.
using RobotMaker = scenario::MakeBuilder;

/// Makes the learners of a family; learners/builder.hpp has `builders_of`.
using LearnerFamily = std::function<std::vector<std::unique_ptr<learners::LearnerBuilder>>()>;

/// Use it as a program's main. It does what the arguments say, and prints that, errors too. Nothing is thrown. It
/// returns the exit code: 0 for success, 1 where something failed, 2 for wrong input, 128 + the signal where one
/// stopped it. Wrong input is also a robot or a learner without a name of its own. share: where the page of reports is.
int cli(int argc, char** argv, const std::vector<RobotMaker>& robots = {},
        const std::vector<LearnerFamily>& learners = {}, const char* share = REHEARSE_SHARE);

}  // namespace rehearse
