#include "rehearse/experiment/given_policy.hpp"

#include <regex>

#include <gtest/gtest.h>

#include "line_run.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/exported_policy.hpp"

namespace rehearse::experiment {
namespace {

using fake::message_of;

scenario::Scenario whole_line() { return fake::LineBuilder().build(); }

/// The first trial of a learner without a prior: a schedule.
std::string schedule_file() {
  const std::filesystem::path folder = fake::test_folder() / "run";
  start_run(fake::catalogue(), fake::line_spec(1, "echo-alone"), folder, {});
  return policy::to_json(exported_policy(read_run(fake::catalogue(), folder)));
}

TEST(GivenPolicy, IsWhatWasExported) {
  const GivenPolicy given = given_policy(schedule_file(), "it.json", whole_line());
  EXPECT_EQ(given.learned.policy->name(), "schedule");
  EXPECT_EQ(given.learned.trial, 1);
  EXPECT_EQ(given.learned.theta, Vector(Vector::LinSpaced(12, -1, 0.5)));
  EXPECT_TRUE(given.total_reward);
}

TEST(GivenPolicy, OfATrialThatIsToComeHasNoReturn) {
  const std::string file = std::regex_replace(schedule_file(), std::regex("\"return\": [^,]*"), "\"return\": null");
  EXPECT_FALSE(given_policy(file, "it.json", whole_line()).total_reward);
}

TEST(GivenPolicy, SaysWhatIsWrong) {
  const std::string file = schedule_file();
  const auto said = [&](const std::string& text) {
    return message_of<InvalidInput>([&] { given_policy(text, "it.json", whole_line()); });
  };
  EXPECT_EQ(said("{\n \"format\": 1,\n"), "it.json is no policy that `export` wrote as JSON: line 3 is no JSON");
  for (const char* text : {"{}", "[1]", "{\"format\": 1}"})
    EXPECT_EQ(said(text), "it.json is no policy that `export` wrote as JSON") << text;
  const auto changed = [&](const std::string& what, const std::string& by) {
    std::string text = file;
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), by);
  };
  EXPECT_NE(said(changed("\"format\": 1", "\"format\": 2")).find("another version"), std::string::npos);
  EXPECT_EQ(said(changed("\"trial\": 1", "\"trial\": -1")), "it.json: trial = -1, must be 1 to 4294967295");
  EXPECT_NE(said(changed("\"name\": \"x\"", "\"name\": \"y\"")).find("its states are others"), std::string::npos);
  EXPECT_NE(said(changed("\"theta\": [\n", "\"theta\": [\n 0.5,\n")).find("theta has 13 numbers"), std::string::npos);
  EXPECT_NE(said(changed("\"theta\": [\n  -1.0", "\"theta\": [\n  0.7")).find("another policy"), std::string::npos);
  EXPECT_NE(said(changed("\"schedule\"", "\"mlp\""))
                .find("it.json is no policy of scenario line: trial 1: the "
                      "policy 'mlp' is neither"),
            std::string::npos);
}

struct StartingBuilder : fake::EchoBuilder {
  StartingBuilder() : EchoBuilder(true, {}) {}
  std::string name() const override { return "starting"; }
  bool takes_start() const override { return true; }
};

TEST(GivenPolicy, OfAnotherKindThanTheLearnersIsRefusedWithTheNamesOfBoth) {
  Catalogue catalogue = fake::catalogue();
  catalogue.learner_families.emplace_back([] {
    std::vector<std::unique_ptr<learners::LearnerBuilder>> family;
    family.push_back(std::make_unique<StartingBuilder>());
    return family;
  });
  const auto said = [&](const std::string& learner, const std::string& text) {
    return message_of<InvalidInput>([&] { with_start(catalogue, fake::line_spec(1, learner), text, "it.json"); });
  };
  const std::string file = schedule_file();
  EXPECT_EQ(said("echo", file), "it.json: learner echo cannot begin with a policy; those that can: starting");
  EXPECT_EQ(said("starting", file),
            "it.json is a policy 'schedule', but learner starting begins with policies 'line' here (option policy)");
  EXPECT_EQ(said("starting", "[]"), "it.json is no policy that `export` wrote as JSON");
}

}  // namespace
}  // namespace rehearse::experiment
