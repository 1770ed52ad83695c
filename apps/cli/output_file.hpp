#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rehearse::apps {

/// A file that a command writes under the name that the user gave it.
struct OutputFile {
  std::filesystem::path path;
  std::string kind;    // "page of Rehearse"
  std::string option;  // "--out FILE.html", which names another file
  std::function<bool(std::string_view text)> is_ours;
  std::vector<std::string> endings = {};  // that its name may have, or none; empty: any
};

/// A page of a report, or a policy that was exported. option: that names another file.
OutputFile page_file(std::filesystem::path path, std::string option);
OutputFile policy_file(std::filesystem::path path, std::string option);

/// "cannot write FILE: …" if its folder is not there or cannot be written; else empty.
std::string why_not_writable(const std::filesystem::path& file);

/// Returns true if there is such a file already. Throws InvalidInput if its name has another ending, something of this
/// name exists that this program did not write, or its folder cannot be written.
bool check_output(const OutputFile& file);

/// Writes a file that passes check_output, or throws InvalidInput. Returns true if one of its own was replaced.
bool write_output(const OutputFile& file, const std::string& text);

/// The same, but an existing file is renamed to NAME-001, NAME-002, …, the first free name, which is returned; none if
/// there is none. Where the new file cannot be written, the existing one has its name again.
std::optional<std::filesystem::path> write_beside_older(const OutputFile& file, const std::string& text);

}  // namespace rehearse::apps
