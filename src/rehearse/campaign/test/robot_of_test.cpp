#include "rehearse/campaign/robot_of.hpp"

#include <gtest/gtest.h>

#include "rehearse/campaign/planner.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/test/fake.hpp"
#include "rehearse/files/write.hpp"

namespace rehearse::campaign {
namespace {

/// A catalogue for which every file describes the robot "line", under the name that the file holds.
experiment::Catalogue reading_catalogue() {
  experiment::Catalogue catalogue = experiment::fake::catalogue();
  class Named final : public scenario::ScenarioBuilder {
   public:
    Named(std::unique_ptr<scenario::ScenarioBuilder> line, std::string name)
        : line_(std::move(line)), name_(std::move(name)) {}
    std::string name() const override { return name_; }
    std::string summary() const override { return line_->summary(); }
    std::vector<std::string> prior_names() const override { return line_->prior_names(); }
    void fields(FieldVisitor& v) override { line_->fields(v); }
    scenario::Scenario build() const override { return line_->build(); }

   private:
    std::unique_ptr<scenario::ScenarioBuilder> line_;
    std::string name_;
  };
  const scenario::MakeBuilder line = catalogue.scenarios.front().make;
  catalogue.read_robot = [line](std::string_view text, const std::string&, const auto&) {
    return [line, name = std::string(text)] { return std::make_unique<Named>(line(), name); };
  };
  return catalogue;
}

TEST(RobotOfACampaign, IsReadFromBesideTheCampaign) {
  const auto folder = experiment::fake::test_folder();
  files::write_file(folder / "mine.toml", "mine");
  const std::string source = folder / "c.toml";
  const std::string text = "format = 1\nscenario = \"mine.toml\"\nlearners = [\"echo\"]\nseeds = \"1\"\ntrials = 1\n";
  const experiment::Catalogue catalogue = with_robot_of(reading_catalogue(), text, source);
  ASSERT_TRUE(catalogue.robot("mine"));
  const CampaignPlan plan = plan_campaign(catalogue, text, source);
  EXPECT_EQ(plan.scenario, "mine");
  EXPECT_EQ(plan.runs.front().spec.scenario, "mine");
  EXPECT_NE(plan.runs.front().spec.robot, "");
}

TEST(RobotOfACampaign, ABuiltInOneNeedsNoFile) {
  const auto catalogue = with_robot_of(reading_catalogue(), "scenario = \"line\"\n", "c.toml");
  EXPECT_TRUE(catalogue.robots.empty());
  EXPECT_EQ(message_of<InvalidInput>(
                [] { with_robot_of(reading_catalogue(), "format = 1\nscenario = \"nowhere.toml\"\n", "c.toml"); }),
            "c.toml: line 2: scenario = 'nowhere.toml': there is no file nowhere.toml");
}

TEST(RobotOfACampaign, RobotsOfOneNameAreOneFile) {
  const experiment::Catalogue once = reading_catalogue().with_robot("mine", "a.toml", "");
  EXPECT_EQ(once.with_robot("mine", "b.toml", "").robots.size(), 1u);
  EXPECT_EQ(once.scenario_name("a.toml"), "mine");
  EXPECT_EQ(once.scenario_name("line"), "line");
  EXPECT_THROW(once.with_robot("line", "a.toml", ""), InvalidInput) << "built in";
  EXPECT_THROW(experiment::fake::catalogue().with_robot("mine", "a.toml", ""), InvalidInput) << "reads none";
}

}  // namespace
}  // namespace rehearse::campaign
