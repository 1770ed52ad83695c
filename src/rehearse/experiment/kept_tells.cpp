#include "rehearse/experiment/kept_tells.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/files/checksum.hpp"
#include "rehearse/files/regular_file.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::experiment {
namespace {

namespace fs = std::filesystem;

// Files that decide how a run goes on; the checkpoint, which is the truth, comes last.
constexpr std::array<const char*, 3> kDeciding{"done", "spec.toml", "checkpoint"};
constexpr const char *kBefore = "before", *kFiles = "files";

fs::path tells_of(const RunFolder& run) { return run.path() / kToldFolder; }

bool is_number(const std::string& name) {
  return name.size() <= 18 && name.find_first_not_of("0123456789") == std::string::npos;
}

Index tell_number(const fs::path& tell) { return std::stol(tell.filename()); }

/// The folders of all tells by number; names have three digits and, from 1000 on, more.
std::vector<fs::path> all_tells(const RunFolder& run) {
  std::vector<fs::path> all;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(tells_of(run), none))
    if (is_number(entry.path().filename().string())) all.push_back(entry.path());
  std::ranges::sort(all, {}, tell_number);
  return all;
}

std::vector<fs::path> files_of(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

/// Leaves `to` as `from` is. The file `done` alone may be missing.
void make_alike(const fs::path& from, const fs::path& to) {
  if (from.filename() == kDeciding.front() && !fs::exists(from)) {
    fs::remove(to);
    return;
  }
  const std::string bytes = files::read_file(from);
  if (!files::holds(to, bytes)) files::write_file(to, bytes, files::Durability::power);
}

/// At once: a tell that a kill leaves half removed would be taken for a whole one.
void remove_tell(const RunFolder& run, const fs::path& folder) {
  const fs::path removed = tells_of(run) / ".removed";
  fs::remove_all(removed);
  fs::rename(folder, removed);
  fs::remove_all(removed);
  std::error_code not_empty;
  fs::remove(tells_of(run), not_empty);
}

/// A file's name so short that file systems take it behind a number or a checksum. Its ending stays.
std::string cut_name(const std::string& name) {
  constexpr std::size_t kMost = 200;  // bytes, of 255
  if (name.size() <= kMost) return name;
  const std::string ending = fs::path(name).extension().string();
  const std::string kept = ending.size() < kMost ? ending : "";
  std::size_t end = kMost - kept.size();
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80) --end;  // not within a letter of UTF-8
  return name.substr(0, end) + kept;
}

void keep_in(const fs::path& folder, const RunFolder& run, const std::vector<ToldFile>& files) {
  fs::create_directories(folder / kBefore);
  fs::create_directories(folder / kFiles);
  for (const char* name : kDeciding) make_alike(run.path() / name, folder / kBefore / name);
  for (std::size_t i = 0; i < files.size(); ++i)
    files::write_file(folder / kFiles / fmt::format("{:03}-{}", i + 1, cut_name(files[i].path.filename().string())),
                      files[i].bytes, files::Durability::power);
}

/// True if there was no tell since.
bool is_untold(const History& before, const History& now) {
  return now.done() == before.done() && now.logs.size() == before.logs.size();
}

}  // namespace

void keep_tell(const RunFolder& run, const std::vector<ToldFile>& files) {
  std::vector<fs::path> all = all_tells(run);
  if (!all.empty() && files::holds(all.back() / kBefore / "checkpoint", files::read_file(run.path() / "checkpoint"))) {
    remove_tell(run, all.back());
    all.pop_back();
  }
  const fs::path unfinished = tells_of(run) / ".unfinished";
  fs::remove_all(unfinished);
  try {
    keep_in(unfinished, run, files);
  } catch (...) {
    std::error_code ignored;  // that of the disk is the one to report
    fs::remove_all(unfinished, ignored);
    fs::remove(tells_of(run), ignored);  // unless others are in it
    throw;
  }
  const Index last = all.empty() ? 0 : tell_number(all.back());
  files::rename_new(unfinished, tells_of(run) / fmt::format("{:03}", last + 1));
}

void forget_tell(const RunFolder& run) {
  const std::vector<fs::path> all = all_tells(run);
  if (!all.empty()) remove_tell(run, all.back());
}

KeptTell last_tell(const RunFolder& run) {
  const std::vector<fs::path> all = all_tells(run);
  if (all.empty())
    throw InvalidInput(fmt::format("{} has nothing to take back: no file was told", run.path().string()));
  KeptTell tell{.folder = all.back(), .before = run.load(all.back() / kBefore), .files = files_of(all.back() / kFiles)};
  const History now = run.load();
  const std::size_t logs = tell.before.logs.size() + (tell.trial() ? 0 : tell.files.size());
  const Index trials = tell.before.done() + (tell.trial() ? 1 : 0);
  const bool untold = is_untold(tell.before, now);  // a kill came before its trial was recorded
  const bool as_told =
      now.done() == trials && now.logs.size() == logs && (!tell.trial() || !now.trials.back().file_checksum.empty());
  if (!untold && !as_told)
    throw InvalidInput(
        fmt::format("trial {}, the last, cannot be taken back: Rehearse drove the robot, no file told it", now.done()));
  return tell;
}

std::vector<fs::path> set_aside(const RunFolder& run, const KeptTell& tell) {
  const fs::path folder = run.path() / "taken-back";
  fs::create_directories(folder);
  std::vector<fs::path> kept;
  for (const fs::path& file : tell.files) {
    const std::string bytes = files::read_file(file), name = file.filename().string();
    kept.push_back(folder /
                   fmt::format("{:016x}-{}", files::checksum(bytes), cut_name(name.substr(name.find('-') + 1))));
    if (!files::holds(kept.back(), bytes)) files::write_file(kept.back(), bytes, files::Durability::power);
  }
  return kept;
}

void restore(const RunFolder& run, const KeptTell& tell) {
  for (const char* name : kDeciding) make_alike(tell.folder / kBefore / name, run.path() / name);
  run.remove_after(tell.before);
}

}  // namespace rehearse::experiment
