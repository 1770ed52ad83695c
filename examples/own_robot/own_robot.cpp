// The cart of cart.hpp in a program with every command of `rehearse`:
//
//   own_robot learn cart --learner gp-mi --trials 3 --out runs/cart
//   own_robot report runs/cart
//
// gp_mi.cpp learns without all that, and own_loop.cpp is for a robot with a control loop of its own.

#include "cart.hpp"
#include "rehearse/cli/cli.hpp"

int main(int argc, char** argv) { return rehearse::cli(argc, argv, {cart}); }
