#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "rehearse/core/types.hpp"

namespace rehearse::report {

/// Something in a folder that could not be used, or did not go well.
struct Problem {
  std::string where;  // relative to the folder
  std::string what;
};

/// The data of a page.
struct Report {
  std::string json;  // numbers to 6 digits
  std::vector<Problem> problems;
};

/// The size of a learner's archive, and the space of descriptors that it covers.
struct ArchiveSpace {
  Index elites = 0, niches = 0;
  std::vector<Interval> bounds;  // of each descriptor
  std::vector<Index> bins;       // of each, of a grid; else empty
};

/// Reads an ArchiveSpace from the bytes of archive.bin. Throws InvalidInput if they are no archive.
using ArchiveReader = std::function<ArchiveSpace(std::string_view bytes)>;

/// Facts of a run's robot that its folder does not have, from a program that knows robots. Empty where that knows none
/// of this name.
struct RobotFacts {
  std::string task;                          // the robot's task, in a line
  std::map<std::string, std::string> units;  // of parameters of priors, by name: "kg"; none for one without a unit
};

/// Functions that add what a folder does not say by itself, from rooms that know archives and robots. Each may be
/// empty.
struct Knowledge {
  ArchiveReader archive;                                         // without it archive.bin is not looked at
  std::function<RobotFacts(const std::string& scenario)> robot;  // scenario: the robot's name
};

}  // namespace rehearse::report
