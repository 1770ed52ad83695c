// Policies whose commands follow from the ones before: what is exported remembers them.
#include "rehearse/policy/exported_commands.hpp"

#include <gtest/gtest.h>

#include "exported_fixture.hpp"

namespace rehearse::policy {
namespace {

using exports::Case, exports::Ran, exports::run;

constexpr Index kCommandSteps = 300;

/// Every kind of policy on a task whose actions have everything between them.
std::vector<Case> remembering_cases() {
  Task task = fixture::task();
  task.actions[0].actuation = {.max_rate = 9, .filter_s = 0.7 * task.dt_s, .delay_s = 2.25 * task.dt_s, .lag_s = 0.05};
  task.actions[1].actuation = {.max_rate = 0.5, .remember = 2};
  task = with_memory(task);
  const FeatureMap features = task.feature_map();
  const Index added = features.features() - fixture::kScale.size();
  Vector scale(features.features());
  scale << fixture::kScale, task.actuators().scale();
  EXPECT_EQ(added, task.memory);
  const Squash squash{task.action_bounds(), 5, Squash::Shape::tanh};
  std::vector<Case> all;
  const auto add = [&](const std::string& name, const std::shared_ptr<const Policy>& policy) {
    // Small weights, so that a command depends little on those long before: rounding errors fade, too.
    all.push_back({name, task, policy, 0.2 * fixture::normals(policy->parameters(), 1, 7)});
  };
  add("linear", make_linear({features, scale, squash}));
  add("mlp", make_mlp({features, scale, 10, squash}));
  add("rbf", make_rbf({features, scale, 10, 0.01, task.action_bounds()}));
  add("schedule", make_schedule(task));
  add("tracking", make_tracking(task, 5));
  return all;
}

/// An episode of a robot that does as it likes: what is measured at each step, and the commands sent.
Exported commanded_episode(const Case& of) {
  const Actuators actuators = of.task.actuators();
  Answers asked{.states = Matrix(kCommandSteps, actuators.states()), .times_s = Vector(kCommandSteps), .actions = {}};
  asked.states.leftCols(actuators.own_states()) = fixture::normals(kCommandSteps, actuators.own_states(), 3);
  asked.states.row(0).tail(actuators.memory()) = actuators.start().transpose();
  const Matrix Theta = of.theta.transpose();
  Matrix U(1, of.policy->actions());
  for (Index t = 0; t < kCommandSteps; ++t) {
    asked.times_s(t) = static_cast<double>(t) * of.task.dt_s;
    const Matrix X = asked.states.middleRows(t, 1);
    of.policy->act(Theta, X, asked.times_s(t), U);
    actuators.command(X, U);
    if (t + 1 < kCommandSteps) actuators.remember(X, U, asked.states.middleRows(t + 1, 1));
  }
  return exports::exported(of, asked);
}

/// The inputs of a program: measured states, and times.
Answers measured_in(const Exported& exported, const Case& of) {
  const Index own = of.task.actuators().own_states();
  return {.states = exported.answers.states.leftCols(own), .times_s = exported.answers.times_s, .actions = {}};
}

constexpr const char* kRememberingProgram = R"(#include <stdio.h>
#include "one.h"
int main(void) {
  double in[ONE_STATES + 1], u[ONE_ACTIONS], memory[ONE_MEMORY];
  const double broken[ONE_STATES] = {NAN};
  one_start(memory);
  while (fread(in, sizeof in, 1, stdin) == 1) {
    if (one_act(in, in[ONE_STATES], memory, u) != 1) return 1;
    if (fwrite(u, sizeof u, 1, stdout) != 1) return 2;
    if (one_act(broken, 0, memory, u) != 0) return 3; /* and remembers nothing of it */
  }
  return 0;
}
)";

TEST(ExportedCommands, ProgramsInCSendTheCommandsOfTheOriginal) {
  exports::write(test_folder() / "program.c", kRememberingProgram);
  const std::string folder = test_folder().string();
  if (run("gcc --version").status != 0) GTEST_SKIP() << "there is no compiler";
  for (const Case& each : remembering_cases())
    for (const char* way : {"gcc -std=c99 -O2", "g++ -x c++ -O2"}) {
      const Exported exported = commanded_episode(each);
      exports::write(test_folder() / "one.h", to_c(exported, "one"));
      exports::write(test_folder() / "in", exports::bytes_of(measured_in(exported, each)));
      const Ran compiled = run(std::string(way) + " -Wall -Wextra -pedantic -Werror " + folder + "/program.c -o " +
                               folder + "/program -lm");
      ASSERT_EQ(compiled.status, 0) << each.name << compiled.output;
      ASSERT_EQ(run("( " + folder + "/program <" + folder + "/in >" + folder + "/out )").status, 0) << each.name;
      const Matrix sent = exports::from_bytes(exports::read(test_folder() / "out"), 2);
      EXPECT_LE(exports::apart(exported, sent), 1e-12) << each.name;
      const Ran itself = run(std::string(way) + " -DREHEARSE_POLICY_MAIN -Wall -Wextra -pedantic -Werror " +
                             (std::string(way).starts_with("gcc") ? "-x c " : "") + folder + "/one.h -o " + folder +
                             "/itself -lm && " + folder + "/itself");
      EXPECT_EQ(itself.status, 0) << each.name << itself.output;
    }
}

constexpr const char* kRememberingModule = R"(
import sys
import numpy as np
import policy
states = int(sys.argv[1])
given = np.fromfile("in").reshape(-1, states + 1)
memory, many = policy.start(), policy.start(3)
commands = []
for row in given:
    commands.append(policy.act(row[:states], row[states], memory))
    both = policy.act(np.tile(row[:states], (3, 1)), row[states], many)
    assert np.allclose(both, commands[-1], rtol=0, atol=1e-13) and np.allclose(many, memory, rtol=0, atol=1e-13)
    before = memory.copy()
    assert np.isnan(policy.act(np.full(states, np.nan), 0.0, memory)).all() and (memory == before).all()
np.array(commands).tofile("out")
)";

TEST(ExportedCommands, ModulesOfNumpySendTheCommandsOfTheOriginal) {
  if (run("python3 -c 'import numpy'").status != 0) GTEST_SKIP() << "there is no NumPy";
  exports::write(test_folder() / "program.py", kRememberingModule);
  for (const Case& each : remembering_cases()) {
    const Exported exported = commanded_episode(each);
    exports::write(test_folder() / "policy.py", to_numpy(exported));
    exports::write(test_folder() / "in", exports::bytes_of(measured_in(exported, each)));
    const Ran ran = run("cd " + test_folder().string() + " && python3 -W error program.py 3 && python3 policy.py");
    ASSERT_EQ(ran.status, 0) << each.name << "\n" << ran.output;
    const Matrix sent = exports::from_bytes(exports::read(test_folder() / "out"), 2);
    EXPECT_LE(exports::apart(exported, sent), 1e-12) << each.name;
  }
}

TEST(ExportedCommands, JsonSaysHowCommandsFollow) {
  const Case of = remembering_cases().front();
  const std::string text = to_json(commanded_episode(of));
  EXPECT_NE(text.find("\"commands\""), std::string::npos);
  EXPECT_NE(text.find("\"max_step\": 0.9"), std::string::npos);
}

}  // namespace
}  // namespace rehearse::policy
