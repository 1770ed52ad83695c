#include "apps/cli/output_file.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::apps {

namespace fs = std::filesystem;

std::optional<fs::path> keep_older(const fs::path& path) {
  if (!fs::exists(fs::symlink_status(path))) return {};
  for (int number = 1;; ++number) {
    fs::path older = path;
    older.replace_filename(fmt::format("{}-{:03}{}", path.stem().string(), number, path.extension().string()));
    if (files::rename_new(path, older)) return older;
  }
}

bool write_output(const OutputFile& file, const std::string& text) {
  if (file.path.empty()) throw InvalidInput("--out needs the name of a file");
  std::error_code ignored;
  const bool there = fs::exists(file.path, ignored);
  if (there && !(fs::is_regular_file(file.path, ignored) && file.is_ours(files::read_file(file.path))))
    throw InvalidInput(fmt::format("{} is no {} and is left as it is; {} names another file", file.path.string(),
                                   file.kind, file.option));
  try {
    files::write_file(file.path, text);
  } catch (const std::runtime_error& error) {
    throw InvalidInput(fmt::format("{}; {} names another file", error.what(), file.option));
  }
  return there;
}

}  // namespace rehearse::apps
