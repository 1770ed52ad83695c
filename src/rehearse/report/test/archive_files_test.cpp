#include "rehearse/report/archive_files.hpp"

#include <gtest/gtest.h>

#include "rehearse/qd/archive_bytes.hpp"
#include "report_folder.hpp"

namespace rehearse::report {
namespace {

std::string read_bytes(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Three elites of two descriptors in a grid, one of them tried.
void write_archive(const fs::path& run) {
  qd::Archive archive(qd::Niches(qd::Grid{{{-1, 1}, {0, 2}}, {4, 5}}), 1);
  for (const Vector& elite : {Vector{{-0.5, 0.1, 2}}, Vector{{0.123456, 1, 3.14159}}, Vector{{1, 2, -1}}})
    archive.add(archive.niches().find(elite.data()), elite(2), elite.data(), elite.data());
  write(run / "archive.bin", qd::to_bytes({archive, 3, 0, "test"}));
  write(run / "elites.csv",
        "reach [m],height [m],promised,expected,deviation\n"
        "-0.5,0.1,2,1.99999,0.1\n0.123456,1,3.14159,0.5,0.2\n1,2,-1,-1.5,0.3\n");
  write(run / "tried.csv", "trial,elite,promised,learned\n1,2,3.14159,1\n2,2,3.14159,0\n");
}

ArchiveSpace archive_space(std::string_view bytes) {
  const qd::Archive archive = qd::from_bytes(bytes, "it is no usable archive").archive;
  const qd::Niches& niches = archive.niches();
  return {archive.size(), niches.size(), niches.bounds(), niches.bins()};
}

class ArchiveFiles : public ReportFolder {};

TEST_F(ArchiveFiles, AnArchiveHasWhatItPromisesAndWhatIsExpectedOfIt) {
  write_run(folder_);
  EXPECT_FALSE(
      json::parse(read_folder(folder_, {.archive = archive_space, .robot = {}}).json)["run"].contains("archive"));
  write_archive(folder_);
  const Report report = read_folder(folder_, {.archive = archive_space, .robot = {}});
  EXPECT_EQ(problems_of(report), Lines{});
  EXPECT_EQ(json::parse(report.json)["run"]["archive"], json::parse(R"({
    "descriptors": [{"name": "reach [m]", "values": [-0.5, 0.1235, 1]}, {"name": "height [m]", "values": [0.1, 1, 2]}],
    "promised": [2, 3.142, -1], "expected": [2, 0.5, -1.5],
    "space": {"niches": 20, "bounds": [[-1, 1], [0, 2]], "bins": [4, 5]},
    "tried": {"trial": [1, 2], "elite": [2, 2], "promised": [3.14159, 3.14159], "learned": [1, 0]}})"));
  EXPECT_FALSE(json::parse(read_trial(folder_, 1).json)["replay"].contains("archive"));
}

TEST_F(ArchiveFiles, ADamagedArchiveIsNamedAndTheTablesAreShown) {
  write_run(folder_);
  write_archive(folder_);
  std::string bytes = read_bytes(folder_ / "archive.bin");
  bytes[bytes.size() - 3] ^= 1;
  write(folder_ / "archive.bin", bytes);
  const std::string damage = "archive.bin: it is no usable archive: damaged: the checksum does not fit";
  Report report = read_folder(folder_, {.archive = archive_space, .robot = {}});
  EXPECT_EQ(problems_of(report), Lines{damage});
  const json archive = json::parse(report.json)["run"]["archive"];
  EXPECT_TRUE(archive["space"].is_null());
  EXPECT_EQ(archive["promised"], json::parse("[2, 3.142, -1]"));

  fs::remove(folder_ / "elites.csv");
  report = read_folder(folder_, {.archive = archive_space, .robot = {}});
  EXPECT_EQ(problems_of(report), (Lines{damage, "elites.csv: it is not there"}));
  EXPECT_FALSE(json::parse(report.json)["run"].contains("archive"));
  fs::remove(folder_ / "tried.csv");  // a run of an older version, or one without a trial
  EXPECT_EQ(problems_of(read_folder(folder_, {.archive = archive_space, .robot = {}})), Lines{damage});
  write(folder_ / "archive.bin", "foreign");
  EXPECT_EQ(problems_of(read_folder(folder_, {.archive = archive_space, .robot = {}})),
            Lines{"archive.bin: it is no usable archive: not an archive of Rehearse"});
}

TEST_F(ArchiveFiles, ThatTablesOfAnArchiveContradictThemselvesIsNamed) {
  write_run(folder_);
  write_archive(folder_);
  const auto problems_with = [&](const char* file, const std::string& text) {
    write_archive(folder_);
    if (text.empty())
      fs::remove(folder_ / file);
    else
      write(folder_ / file, text);
    return problems_of(read_folder(folder_, {.archive = archive_space, .robot = {}}));
  };
  const std::string header = "reach [m],height [m],promised,expected,deviation\n";
  EXPECT_EQ(problems_with("elites.csv", "promised,expected\n1,2\n"),
            Lines{"elites.csv: there are no descriptors before a column promised"});
  EXPECT_EQ(problems_with("elites.csv", header), Lines{"elites.csv: it has no elites"});
  EXPECT_EQ(problems_with("elites.csv", header + "0,0,1,,1\n"), Lines{"elites.csv: row 2 has no finite expected"});
  EXPECT_EQ(problems_with("elites.csv", header + "0,0,1,1,1\n0,0,1"), Lines{"elites.csv: row 3 is cut short"});
  EXPECT_EQ(problems_with("elites.csv", header + "0,0,1,1,1\n0,0,1,1,1\n"),
            Lines({"archive.bin: it has 3 elites of 2 descriptors, elites.csv 2 of 2"}));
  EXPECT_EQ(problems_with("archive.bin", ""), Lines{"archive.bin: it is not there"});
  EXPECT_EQ(problems_with("tried.csv", ""), Lines{"tried.csv: it is not there"});
  EXPECT_EQ(problems_with("tried.csv", "trial,elite,promised,learned\n1,4,1,1\n"),
            Lines{"tried.csv: elite 4 is not among the 3 of elites.csv"});
}

}  // namespace
}  // namespace rehearse::report
