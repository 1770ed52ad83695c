#pragma once

#include <string>

#include "rehearse/experiment/spec.hpp"

namespace rehearse::campaign {

constexpr std::size_t kLongestFolderName = 240;  // bytes; file systems take 255

/// The name of a run's folder, which is one on every file system. variant: "NAME,key=value,…", or empty.
std::string folder_name(const experiment::Spec& spec, const std::string& variant);

}  // namespace rehearse::campaign
