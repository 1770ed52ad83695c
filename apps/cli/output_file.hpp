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

/// Renames an existing file to NAME-001, NAME-002, …, the first free name, and returns that; none if there is no file.
std::optional<std::filesystem::path> keep_older(const std::filesystem::path& path);

/// Writes the file. Throws InvalidInput if a file of this name exists that this program did not write. Returns true if
/// one of its own was replaced.
bool write_output(const OutputFile& file, const std::string& text);

}  // namespace rehearse::apps
