#include "rehearse/cli/cli.hpp"

int main(int argc, char** argv) { return rehearse::cli(argc, argv); }
