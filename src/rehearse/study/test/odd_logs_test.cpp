#include "rehearse/study/odd_logs.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/study/summary.hpp"
#include "rehearse/study/tables.hpp"
#include "rehearse/study/test/swings.hpp"

namespace rehearse::study {
namespace {

TEST(OddLogs, OneMustBeFarFromAllOthers) {
  EXPECT_EQ(odd_log({0.2, 0.9, 0.1}), 1);
  EXPECT_EQ(odd_log({0.02, 0.2, 0.01}), std::nullopt) << "much of it is explained";
  EXPECT_EQ(odd_log({0.8, 0.9, 0.1}), std::nullopt) << "of two nobody knows which";
  EXPECT_EQ(odd_log({0.1, 0.9}), std::nullopt);
  EXPECT_EQ(odd_log({0.9, NAN, 0.1}), std::nullopt);
  EXPECT_EQ(odd_log({NAN, 0.9, 0.1}), std::nullopt);
  EXPECT_EQ(odd_log({NAN, 0.1, 0.9, 0.2}), 2);
}

TEST(OddLogs, AForecastOfNoChangeExplainsNothing) {
  const Matrix measured{{0}, {1}, {2}, {3}};
  const auto forecasts = [&](double step) {
    Forecasts all{.starts = {0, 1}, .horizons = {1}};
    all.at.push_back({Matrix{{step}, {1 + step}}, Matrix::Ones(2, 1), Matrix{{1}, {2}}});
    return all;
  };
  EXPECT_DOUBLE_EQ(unexplained(forecasts(0), measured), 1);
  EXPECT_DOUBLE_EQ(unexplained(forecasts(0.75), measured), 0.25);
  EXPECT_TRUE(std::isnan(unexplained(forecasts(NAN), measured)));
}

TEST(OddLogs, ALogWhoseActionsHaveAnotherSignIsNamed) {
  const Task task = swinging_task();
  const prior::Prior prior = swinging_prior();
  Options options;
  options.rows = 150, options.particles = 20, options.beyond = Beyond::nothing;
  std::vector<Log> logs;
  for (std::uint64_t i = 1; i <= 4; ++i) logs.push_back(swinging_log(i, 0));
  const std::vector<Log> none;
  const Problem problem{task, prior, logs, none};
  EXPECT_EQ(study_logs(problem, options, serial_evaluator()).odd_log, "");
  logs[2].episode.actions *= -1;
  const Study study = study_logs(problem, options, serial_evaluator());
  EXPECT_EQ(study.odd_log.find("log 3: what the other logs teach leaves"), 0U) << study.odd_log;
  const auto notes = summary(study, problem)[0].notes;
  EXPECT_NE(std::ranges::find(notes, study.odd_log), notes.end());
  bool in_tables = false;
  for (const auto& [name, text] : csv_files(study, problem))
    in_tables |= name == "warnings.csv" && text.find("log 3: what") != std::string::npos;
  EXPECT_TRUE(in_tables);
}

}  // namespace
}  // namespace rehearse::study
