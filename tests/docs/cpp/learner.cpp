#include "rehearse/learners/builder.hpp"

//: CONTRIBUTING.md learners::NAME
