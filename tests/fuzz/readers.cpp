#include "tests/fuzz/readers.hpp"

#include <algorithm>
#include <new>
#include <stdexcept>

#include "rehearse/campaign/file.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/checkpoint.hpp"
#include "rehearse/experiment/given_policy.hpp"
#include "rehearse/experiment/preset.hpp"
#include "rehearse/experiment/spec_file.hpp"
#include "rehearse/files/regular_file.hpp"
#include "rehearse/files/seal.hpp"
#include "rehearse/files/table.hpp"
#include "rehearse/files/temporary_folder.hpp"
#include "rehearse/files/toml_reader.hpp"
#include "rehearse/mujoco/simulator.hpp"
#include "rehearse/qd/archive_bytes.hpp"
#include "rehearse/recording/recording.hpp"
#include "rehearse/report/files.hpp"
#include "rehearse/robot_file/read.hpp"
#include "rehearse/robot_file/robot_file.hpp"
#include "rehearse/robots/pendulum/pendulum.hpp"
#include "rehearse/system/answers.hpp"
#include "rehearse/system/messages.hpp"

namespace rehearse::fuzz {
namespace {

constexpr std::uint64_t kFingerprint = 17;  // of the spec that checkpoints belong to

const scenario::Scenario& pendulum() {
  static const scenario::Scenario scenario = robots::pendulum::builder()->build();
  return scenario;
}

/// Whatever model a robot's file names, it is this one.
std::optional<std::string> file_beside(const std::string& path) {
  static const std::string model = files::read_file(std::string(REHEARSE_SOURCE) + "/examples/models/acrobot.xml");
  return path.ends_with(".xml") ? std::optional<std::string>(model) : std::nullopt;
}

/// No program is started: a robot that has one is read and no more.
void read_robot(std::string_view text) {
  const robot_file::Robot robot = robot_file::read(text, "robot.toml", file_beside);
  for (const robot_file::Dynamics& dynamics : robot.dynamics)
    if (std::holds_alternative<robot_file::ProgramSource>(dynamics.source)) return;
  (void)robot_file::builder(text, "robot.toml", file_beside)->build();
}

/// A model without states and actions: the file alone is read.
void read_mjcf(std::string_view text) {
  static const files::TemporaryFolder folder;
  folder.add("model.xml", text);
  const mujoco::ModelDescription model{.path = (folder.path() / "model.xml").string(), .dt_s = 0.01, .substeps = 1};
  (void)mujoco::warnings_of(mujoco::compile(model), {}, {});
}

void read_campaign(std::string_view text) {
  files::FileViolations violations("campaign.toml");
  (void)campaign::read_campaign_file(text, "campaign.toml", violations);
  violations.throw_if_any();
}

void read_spec(std::string_view text) { (void)experiment::from_toml(text, "spec.toml"); }

void read_preset(std::string_view text) { (void)experiment::Preset(text, "preset.toml").options("pendulum", "gp-mi"); }

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

/// An episode of whole rows, finite and in its bounds, or a refusal that names the file.
void read_recording(std::string_view text) try {
  const Task& task = pendulum().task;
  const Episode episode = recording::read_recording(std::string(text), "log.csv", task).episode;
  require(episode.steps() >= 1, "an episode without a step");
  require(episode.states.rows() == episode.steps() + 1, "an episode without its last state");
  require(episode.states.allFinite() && episode.actions.allFinite(), "an episode that is not finite");
  for (std::size_t a = 0; a < task.actions.size(); ++a) {
    const auto [low, high] = task.actions[a].bounds;
    const auto column = episode.actions.col(static_cast<Index>(a)).array();
    require((column >= low && column <= high).all(), "an action out of its bounds");
  }
} catch (const InvalidInput& error) {
  require(std::string_view(error.what()).starts_with("log.csv: "), "a refusal that does not name the file");
  throw;
}

void read_policy(std::string_view text) {
  (void)experiment::given_policy(std::string(text), "policy.json", pendulum());
}

void read_table(std::string_view text) {
  const files::Table table = files::read_csv(text);
  report::Problems problems;
  (void)report::columns(table, "trials.csv", problems);
}

/// Reads a checkpoint with a right checksum, as an attacker would write it.
void read_checkpoint(std::string_view body) {
  (void)experiment::from_checkpoint(files::seal("checkpoint", body), kFingerprint);
}

void read_archive(std::string_view bytes) {
  std::string sealed(bytes);
  qd::fit_checksum(sealed);
  (void)qd::from_bytes(sealed, "archive.bin");
}

/// Reads an answer; the first byte selects its kind.
void read_message(std::string_view bytes) {
  if (bytes.empty()) return;
  const std::string_view text = bytes.substr(1);
  const system::Program program{.states = {"dq", "q"}, .actions = {"u"}, .parameters = {"m"}, .dt_s = 0.1};
  Matrix dX(3, 2);
  switch (bytes[0] % 3) {
    case 0:
      (void)system::messages::read_hello(text, program);
      break;
    case 1:
      system::messages::read_change(text, dX);
      break;
    default:
      (void)system::messages::read_state(text, 2);
  }
}

/// The first end that `end` finds when what a program wrote comes in pieces; 0: none.
std::size_t end_in_pieces(std::string_view written, std::size_t (*end)(std::string_view)) {
  const std::size_t piece = written.size() / 16 + 1;
  for (std::size_t size = 0; size < written.size(); size += piece) {
    const std::size_t found = end(written.substr(0, size));
    require(found <= size || found == system::kNoAnswer, "an answer that is longer than what was written");
    if (found > 0) return found;
  }
  return end(written);
}

/// Reads an answer; the first byte selects raw numbers or text.
void read_answer(std::string_view bytes) {
  if (bytes.empty()) return;
  const std::string_view written = bytes.substr(1);
  if (bytes[0] % 2 == 0) {
    const std::size_t end = end_in_pieces(written, system::object_line);
    require(end == system::object_line(written), "a line that ends elsewhere when more has come");
    if (end > 0) require(system::last_line(written.substr(0, end)).starts_with('{'), "a line that is no object");
    return;
  }
  Matrix dX(3, 2);
  const std::size_t end = end_in_pieces(written, [](std::string_view text) { return system::frame_end(text, 3, 2); });
  if (end == system::kNoAnswer) throw std::runtime_error("it wrote something else than the answer");
  if (end > 0) system::read_frame(written.substr(0, end), dX);
}

template <class Refusal>
std::function<bool(std::string_view)> refusing(void (*read)(std::string_view)) {
  return [read](std::string_view bytes) {
    try {
      read(bytes);
      return true;
    } catch (const Refusal&) {
    } catch (const std::bad_alloc&) {
      // The command line says so in a sentence, too.
    }
    return false;
  };
}

}  // namespace

const std::vector<Reader>& readers() {
  static const std::vector<Reader> all{
      {"robot", refusing<InvalidInput>(read_robot)},         {"campaign", refusing<InvalidInput>(read_campaign)},
      {"spec", refusing<InvalidInput>(read_spec)},           {"preset", refusing<InvalidInput>(read_preset)},
      {"recording", refusing<InvalidInput>(read_recording)}, {"table", refusing<InvalidInput>(read_table)},
      {"policy", refusing<InvalidInput>(read_policy)},       {"checkpoint", refusing<InvalidInput>(read_checkpoint)},
      {"archive", refusing<InvalidInput>(read_archive)},     {"message", refusing<std::runtime_error>(read_message)},
      {"answer", refusing<std::runtime_error>(read_answer)}, {"mjcf", refusing<InvalidInput>(read_mjcf)},
  };
  return all;
}

const Reader* reader_of(std::string_view name) {
  const auto found = std::ranges::find(readers(), name, &Reader::name);
  return found == readers().end() ? nullptr : &*found;
}

}  // namespace rehearse::fuzz
