#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

namespace rehearse {

/// Removes folders when the program ends.
class Remover {
 public:
  ~Remover() {
    std::error_code ignored;
    for (const std::filesystem::path& path : paths) std::filesystem::remove_all(path, ignored);
  }
  std::vector<std::filesystem::path> paths;
};

/// A folder of its own for each test, empty at its start; in memory where there is such a place, because checkpoints
/// wait for the disk.
inline std::filesystem::path test_folder() {
  static Remover remover;
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  std::filesystem::path root = "/dev/shm";
  if (!is_directory(root)) root = ::testing::TempDir();
  remover.paths.push_back(root / ("rehearse-test-" + std::to_string(::getpid())));
  const std::filesystem::path path = remover.paths.back() / info->test_suite_name() / info->name();
  std::filesystem::create_directories(path);
  return path;
}

/// The message of the exception that `action` throws; empty if it throws none.
template <class Error, class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace rehearse
