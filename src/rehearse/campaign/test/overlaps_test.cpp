#include "rehearse/campaign/overlaps.hpp"

#include <gtest/gtest.h>

#include "plans.hpp"
#include "rehearse/campaign/planner.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/resolve.hpp"

namespace rehearse::campaign {
namespace {

using Lines = std::vector<std::string>;

/// The complaint about a file whose tables begin at line 5.
std::string complaint_of_tables(const std::string& tables, const std::string& priors = "\"near\"") {
  const std::string head =
      "format = 1\nscenario = \"line\"\nseeds = [4, 2]\nlearners = [\"echo\"]; priors = [" + priors;
  const std::string text = std::string(head).replace(head.find("; "), 2, "\n") + "]\n" + tables;
  return plans::complaint(text);
}

TEST(CampaignOverlaps, ADrawnOptionIsNeitherVariedNorSet) {
  EXPECT_EQ(complaint_of_tables("[vary]\nprior.gain = [1, 2]\n[draw]\nprior.gain = [1, 2]\n"),
            "c.toml: line 9: prior.gain of [draw] is in [vary] too, line 7: only one of them would count");
  EXPECT_EQ(complaint_of_tables("[draw]\nprior.gain = [1, 2]\n[vary]\nprior.gain = [1, 2]\n"),
            "c.toml: line 9: prior.gain of [vary] is in [draw] too, line 7: only one of them would count");
  EXPECT_EQ(complaint_of_tables("[set]\nnoise = 1\n[draw]\nnoise = [1, 2]\n"),
            "c.toml: line 9: noise of [draw] is in [set] too, line 7: only one of them would count");
  EXPECT_EQ(complaint_of_tables("[learner.echo]\nsearch.step = 1\n[draw]\nsearch.step = [1, 2]\n"),
            "c.toml: line 9: search.step of [draw] is in [learner.echo] too, line 7: only one of them would count");
  EXPECT_EQ(complaint_of_tables("[[variant]]\nname = \"a\"\nset.noise = 1\n[draw]\nnoise = [1, 2]\n"),
            "c.toml: line 10: noise of [draw] is in [[variant]] too, line 8: only one of them would count");
}

TEST(CampaignOverlaps, NeitherIsAVariedOneVariedTwice) {
  EXPECT_EQ(complaint_of_tables("[[variant]]\nname = \"a\"\nset.noise = 1\n[vary]\nnoise = [1, 2]\n"),
            "c.toml: line 10: noise of [vary] is in [[variant]] too, line 8: only one of them would count");
  EXPECT_EQ(complaint_of_tables("[vary]\nnoise = [1, 2]\nscenario.noise = [3, 4]\n"),
            "c.toml: line 8: scenario.noise of [vary] is in [vary] too, line 7 as noise: only one of them would count");
}

TEST(CampaignOverlaps, OtherNamesOfAnOptionAreTheSameOption) {
  EXPECT_EQ(complaint_of_tables("[vary]\nprior.near.gain = [1, 2]\n[draw]\nprior.gain = [1, 2]\n"),
            "c.toml: line 9: prior.gain of [draw] is in [vary] too, line 7 as prior.near.gain: only one of them would "
            "count");
  EXPECT_EQ(complaint_of_tables("[set]\nscenario.plant.gain = 1\n[draw]\nplant.gain = [1, 2]\n"),
            "c.toml: line 9: plant.gain of [draw] is in [set] too, line 7 as scenario.plant.gain: only one of them "
            "would count");
}

TEST(CampaignOverlaps, DifferentOptionsAndVariantsAreFine) {
  EXPECT_EQ(complaint_of_tables("[set]\nnoise = 1\n[vary]\nnoise = [1, 2]\n[draw]\nprior.gain = [1, 2]\n"), "");
  EXPECT_EQ(complaint_of_tables("[[variant]]\nname = \"a\"\nset.noise = 1\n[[variant]]\nname = \"b\"\nset.noise = 2\n"),
            "");
  EXPECT_EQ(
      complaint_of_tables("[vary]\nprior.near.gain = [1, 2]\n[draw]\nprior.far.gain = [1, 2]\n", "\"near\", \"far\""),
      "")
      << "no run has both";
}

TEST(CampaignOverlaps, ReachedOptionsHaveTheirCompleteNames) {
  const experiment::Spec one =
      experiment::completed(experiment::fake::catalogue(), {.scenario = "line", .learner = "echo", .prior = "near"});
  EXPECT_EQ(reached_options(one, "noise"), Lines{"scenario.noise"});
  EXPECT_EQ(reached_options(one, "prior.near.gain"), Lines{"prior.gain"});
  EXPECT_EQ(reached_options(one, "prior.far.gain"), Lines{});
  EXPECT_EQ(reached_options(one, "told_by"), Lines{"told_by"}) << "of the run itself";
  EXPECT_EQ(reached_options(one, "trials"), Lines{}) << "the campaign's";
  const experiment::Spec two = experiment::completed(experiment::fake::catalogue(),
                                                     {.scenario = "line", .learner = "echo", .prior = "near,far"});
  EXPECT_EQ(reached_options(two, "prior.gain"), (Lines{"prior.near.gain", "prior.far.gain"}));
  EXPECT_EQ(reached_options(two, "prior.far.gain"), Lines{"prior.far.gain"});
}

}  // namespace
}  // namespace rehearse::campaign
