#include "apps/cli/output_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/files/write.hpp"
#include "rehearse/policy/exported.hpp"

namespace rehearse::apps {

namespace fs = std::filesystem;

namespace {

std::string naming_another(const OutputFile& file, const std::string& why) {
  return fmt::format("{}; {} names another file", why, file.option);
}

[[noreturn]] void refuse_output(const OutputFile& file, const std::string& why) {
  throw InvalidInput(naming_another(file, why));
}

/// Renames a file to the first free of NAME-001, NAME-002, …
fs::path keep_older(const fs::path& path) {
  for (int number = 1;; ++number) {
    fs::path older = path;
    older.replace_filename(fmt::format("{}-{:03}{}", path.stem().string(), number, path.extension().string()));
    if (files::rename_new(path, older)) return older;
  }
}

}  // namespace

OutputFile page_file(fs::path path, std::string option) {
  constexpr std::string_view kBegins = "<!doctype html>";
  return {.path = std::move(path),
          .kind = "page of Rehearse",
          .option = std::move(option),
          .is_ours = [](std::string_view text) { return text.starts_with(kBegins); },
          .endings = {".html", ".htm"}};
}

OutputFile policy_file(fs::path path, std::string option) {
  return {.path = std::move(path),
          .kind = "policy of Rehearse",
          .option = std::move(option),
          .is_ours = policy::is_exported};
}

std::string why_not_writable(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (::access(folder.c_str(), W_OK | X_OK) == 0) return "";
  if (errno == ENOENT) return fmt::format("cannot write {}: there is no folder {}", file.string(), folder.string());
  return fmt::format("cannot write {}: {}", file.string(), std::strerror(errno));
}

bool check_output(const OutputFile& file) {
  if (file.path.empty()) throw InvalidInput("--out needs the name of a file");
  if (const std::string ending = file.path.extension().string();
      !ending.empty() && !file.endings.empty() && std::ranges::find(file.endings, ending) == file.endings.end())
    throw InvalidInput(
        fmt::format("{}: a {} must end in {}", file.path.string(), file.kind, fmt::join(file.endings, " or ")));
  std::error_code ignored;
  const fs::file_status status = fs::symlink_status(file.path, ignored);
  const auto is_ours = [&] {
    if (!fs::is_regular_file(status)) return fs::is_symlink(status) && !fs::exists(file.path, ignored);
    return fs::file_size(file.path, ignored) == 0 || file.is_ours(files::read_file(file.path));
  };
  if (fs::exists(status) && !is_ours())
    refuse_output(file, fmt::format("{} is no {} and is left as it is", file.path.string(), file.kind));
  if (const std::string why = why_not_writable(file.path); !why.empty()) refuse_output(file, why);
  return fs::exists(status);
}

bool write_output(const OutputFile& file, const std::string& text) {
  const bool there = check_output(file);
  try {
    files::write_shared_file(file.path, text);  // whose temporary name is nobody else's
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(naming_another(file, error.what()));  // a full disk is no wrong input
  }
  return there;
}

std::optional<fs::path> write_beside_older(const OutputFile& file, const std::string& text) {
  if (!check_output(file)) return write_output(file, text), std::nullopt;
  const fs::path older = keep_older(file.path);
  try {
    write_output(file, text);
  } catch (...) {
    files::rename_new(older, file.path);
    throw;
  }
  return older;
}

}  // namespace rehearse::apps
