#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace rehearse::apps {

/// A file that a command writes under the name that the user gave it.
struct OutputFile {
  std::filesystem::path path;
  std::string kind;    // "page of Rehearse"
  std::string option;  // "--out FILE.html", which names another file
  std::function<bool(std::string_view text)> is_ours;
};

/// Renames what is there under this name to NAME-001, NAME-002, …, the first that is free, and returns that; none if
/// nothing is there.
std::optional<std::filesystem::path> keep_older(const std::filesystem::path& path);

/// Writes it. Whatever is there under this name and is not ours may be the work of hours: that throws InvalidInput.
/// Returns whether one of ours was replaced.
bool write_output(const OutputFile& file, const std::string& text);

}  // namespace rehearse::apps
