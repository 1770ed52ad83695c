// Your own learner in a program with every command of `rehearse`, on the robots that come with it:
//
//   own_learner learn pendulum --learner random-search --trials 3 --out runs/random
//
// random_search.hpp says how it gets into `rehearse` itself; by_hand.cpp shows the loop of learning without all that.

#include "random_search.hpp"
#include "rehearse/cli/cli.hpp"

int main(int argc, char** argv) { return rehearse::cli(argc, argv, {}, {rehearse::learners::random_search::builders}); }
