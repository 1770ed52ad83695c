// The message "end" of robots that are programs.
#include <filesystem>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/core/test/test_tools.hpp"
#include "rehearse/files/temporary_folder.hpp"
#include "rehearse/system/program_simulator.hpp"
#include "rehearse/system/test/programs.hpp"

namespace rehearse::system {
namespace {

TEST(ProgramPlant, IsToldOfTheEndOfAnEpisode) {
  const auto plant = make_program_plant(robot_program(), shift_of(3), {Vector{{1, 2, 3}}, Vector::Zero(3), {}});
  Rng rng({.seed = 1});
  for (int before = 0; before < 2; ++before) {
    const EpisodeOn on_plant(*plant);
    EXPECT_EQ(plant->reset(rng)(0), 1 + 100 * before);
  }
}

TEST(ProgramPlant, IsToldOfTheEndOfAnEpisodeThatItCannotGoOnWith) {
  const files::TemporaryFolder folder;
  const std::string off = (folder.path() / "torque-off").string();
  Program program = test_program(
      {"sh", "-c",
       R"(while read -r line; do case $line in *rehearse*) echo '{"rehearse":1,"messages":["reset","step","end"]}';; )"
       R"(*reset*) echo '{"state":[1,2,3]}';; *step*) echo '{"error":"the motor is hot"}';; *end*) touch )" +
           off + R"(; echo '{"end":true}';; esac; done)"});
  const auto plant = make_program_plant(program, shift_of(3), {Vector{{1, 2, 3}}, Vector::Zero(3), {}});
  Rng rng({.seed = 1});
  plant->reset(rng);
  const std::string said = message_of<Unavailable>([&] { plant->step(Vector{{1}}); });
  EXPECT_NE(said.find("the motor is hot"), std::string::npos) << said;
  EXPECT_TRUE(std::filesystem::exists(off));
  plant->finish();
  plant->require_finished();
  EXPECT_EQ(plant->reset(rng), (Vector{{1, 2, 3}})) << "another process";
}

TEST(ProgramPlant, AnEndThatIsNotAnsweredWellIsSaidOnce) {
  const std::string serve =
      R"(while read -r line; do case $line in *rehearse*) echo '{"rehearse":1,"messages":["reset","step","end"]}';; )"
      R"(*reset*) echo '{"state":[1,2,3]}';; *end*) )";
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {R"(echo '{"done":true}';;)", "its answer has no \"end\": {\"done\":true}"},
      {R"(echo '{"error":"it still moves"}';;)", "it still moves"},
      {"exit 3;;", "exit status 3"},
      {"sleep 100;;", "within 0.3 s"}};
  for (const auto& [answer, why] : wrong) {
    Program program = test_program({"sh", "-c", serve + answer + " esac; done"});
    program.answer_s = why.starts_with("within") ? 0.3 : 5;
    const auto plant = make_program_plant(program, shift_of(3), {Vector{{1, 2, 3}}, Vector::Zero(3), {}});
    Rng rng({.seed = 1});
    plant->reset(rng);
    plant->finish();
    const bool by_reset = why.starts_with("exit");  // or by who asks for it, such as after a last trial
    const std::string said =
        message_of<Unavailable>([&] { by_reset ? (void)plant->reset(rng) : plant->require_finished(); });
    EXPECT_EQ(said.find("the message \"end\" of the last episode, at which the robot's torque is taken off"), 0u);
    EXPECT_NE(said.find(why), std::string::npos) << said;
    plant->require_finished();
    EXPECT_EQ(plant->reset(rng), (Vector{{1, 2, 3}})) << "another process";
  }
}

TEST(ProgramPlant, AnAnswerTooManyIsSaidByTheNextResetAndTheDriverEndsByItself) {
  const files::TemporaryFolder folder;
  const std::string off = (folder.path() / "torque-off").string();
  Program program = test_program(
      {"sh", "-c",
       R"(while read -r line; do case $line in *rehearse*) echo '{"rehearse":1,"messages":["reset","step","end"]}';; )"
       R"(*reset*) printf '%s\n%s\n' '{"state":[1,2,3]}' '{"state":[1,2,3]}';; esac; done; touch )" +
           off});
  const auto plant = make_program_plant(program, shift_of(3), {Vector{{1, 2, 3}}, Vector::Zero(3), {}});
  Rng rng({.seed = 1});
  plant->reset(rng);
  plant->finish();
  EXPECT_TRUE(std::filesystem::exists(off)) << "its input ended, and it was not killed";
  const std::string said = message_of<Unavailable>([&] { plant->reset(rng); });
  EXPECT_NE(said.find("that nobody asked for"), std::string::npos) << said;
}

}  // namespace
}  // namespace rehearse::system
