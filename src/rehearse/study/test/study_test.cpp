#include "rehearse/study/study.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/test/test_tools.hpp"
#include "rehearse/study/page.hpp"
#include "rehearse/study/summary.hpp"
#include "rehearse/study/tables.hpp"
#include "rehearse/study/test/swings.hpp"

namespace rehearse::study {
namespace {

TEST(Study, PredictsHeldOutLogsInsideItsBands) {
  const Case swings;
  const Study study = swings.run();
  ASSERT_EQ(study.held_out.model.size(), 1U);
  for (Index h = 0; h < 3; ++h) {
    EXPECT_LT(study.held_out.of_model.rms(h, 1), 0.5 * study.held_out.of_prior.rms(h, 1));
    EXPECT_GT(study.held_out.of_model.covered(h, 1), 0.8);
  }
  EXPECT_NEAR(study.held_out.offsets[0](1), -0.04, 0.02);
  EXPECT_EQ(study.without.size(), 3U);
  const Problem problem = swings.problem();
  const auto files = csv_files(study, problem);
  EXPECT_EQ(files.size(), 5U + 3U);
  for (const auto& [name, text] : files) EXPECT_EQ(text.find("00000000001,"), std::string::npos) << name << ": 0.7 s";
  const std::vector<Section> sections = summary(study, problem);
  EXPECT_EQ(sections.size(), 5U);
  EXPECT_EQ(lines_of(sections[1]).front().substr(0, 16), "parameter  value");
  EXPECT_EQ(sections[1].table[0].size(), 4U + study.without.size());
  for (const Section& section : sections)
    for (const auto& row : section.table) EXPECT_EQ(row.size(), section.table.front().size()) << section.title;
  const std::string html = page(study, problem, "a <swing>");
  EXPECT_EQ(html.find("<swing>"), std::string::npos);
  EXPECT_EQ(html.find("nan"), std::string::npos);
}

TEST(Study, OfOneLogEitherHalfIsLeftOut) {
  Case swings;
  swings.logs.resize(1);
  swings.held_out.clear();
  swings.options.beyond = Beyond::nothing;
  swings.options.zero_s = 1;
  const Study study = swings.run();
  EXPECT_EQ(study.left_out_logs.logs, (std::vector<std::string>{"log 1 (first half)", "log 1 (second half)"}));
  EXPECT_EQ(summary(study, swings.problem()).size(), 4U);
}

TEST(Study, SaysWhatMovesNothing) {
  Case swings;
  swings.logs = {swinging_log(1, 0), swinging_log(2, 0, 0.002, 0)};
  swings.held_out.clear();
  swings.options.beyond = Beyond::nothing;
  const Section parameters = summary(swings.run(), swings.problem())[1];
  EXPECT_NE(parameters.table[1][3], "nothing moves");  // of both
  EXPECT_EQ(parameters.table[1][4], "nothing moves");  // without the first
  EXPECT_NE(parameters.table[1][5], "nothing moves");
  for (const std::string& note : parameters.notes) EXPECT_EQ(note.find("do not overlap"), std::string::npos) << note;
}

TEST(Study, WrongInputIsRefused) {
  Case swings;
  swings.options.zeros = "qq";
  EXPECT_THROW(swings.run(), InvalidInput);
  swings.options.zeros = "q";
  swings.options.zero_s = 100;
  const std::string refused = rehearse::message_of<InvalidInput>([&] { swings.run(); });
  EXPECT_NE(refused.find(swings.logs.front().name + ": zero_s = 100, must be less than its "), std::string::npos)
      << refused;
  swings.options.zero_s = 0.1;
  EXPECT_EQ(rehearse::message_of<InvalidInput>([&] { swings.run(); }),
            "zero_s = 0.1, must be at least the 0.2 s that parameters are fitted to (fit_horizon_s = 0.2)");
  swings.options.zeros = "";
  swings.logs.front().episode = swings.logs.front().episode.part(0, 3);
  swings.logs.resize(2);
  try {
    swings.run();
    FAIL() << "one log is no other's test";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("3 control steps, must be at least the"), std::string::npos);
  }
  swings.logs.clear();
  EXPECT_THROW(swings.run(), InvalidInput);
}

}  // namespace
}  // namespace rehearse::study
