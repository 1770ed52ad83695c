#include <gtest/gtest.h>

#include "exported_fixture.hpp"

namespace rehearse::policy {
namespace {

using exports::Case, exports::Ran, exports::run;

constexpr const char* kModuleProgram = R"(
import sys
import numpy as np
import policy
states = int(sys.argv[1])
given = np.fromfile("in").reshape(-1, states + 1)
policy.act(given[:, :states], given[:, states]).tofile("out")
one = policy.act(given[0, :states], given[0, states])
assert np.allclose(one, policy.act(given[:1, :states], given[0, states])[0], rtol=0, atol=1e-14, equal_nan=True), one
)";

Matrix actions_of(const Case& of, const Answers& asked) {
  const auto folder = test_folder();
  exports::write(folder / "in", exports::bytes_of(asked));
  const Ran ran =
      run("cd " + folder.string() + " && python3 -W error program.py " + std::to_string(asked.states.cols()));
  EXPECT_EQ(ran.status, 0) << of.name << "\n" << ran.output;
  return exports::from_bytes(exports::read(folder / "out"), of.policy->actions());
}

TEST(ExportedNumpy, IsThePolicy) {
  if (run("python3 -c 'import numpy'").status != 0) GTEST_SKIP() << "there is no NumPy";
  exports::write(test_folder() / "program.py", kModuleProgram);
  for (const Case& each : exports::cases()) {
    exports::write(test_folder() / "policy.py", to_numpy(exports::exported(each, exports::asked(8, each.task.dt_s))));
    const Exported many = exports::exported(each, exports::asked(10'000, each.task.dt_s));
    EXPECT_LE(exports::apart(many, actions_of(each, many.answers)), 1e-12) << each.name;
    exports::check_hostile(each, exports::hostile(), actions_of(each, exports::hostile()));
  }
}

TEST(ExportedNumpy, TestsItself) {
  if (run("python3 -c 'import numpy'").status != 0) GTEST_SKIP() << "there is no NumPy";
  const std::string path = (test_folder() / "itself.py").string();
  for (const Case& each : exports::cases()) {
    Exported exported = exports::exported(each, exports::asked(8, each.task.dt_s));
    exports::write(path, to_numpy(exported));
    const Ran right = run("python3 " + path);
    EXPECT_EQ(right.status, 0) << each.name << "\n" << right.output;
    exported.answers.actions(3, 1) += 1e-6;
    exports::write(path, to_numpy(exported));
    EXPECT_NE(run("python3 " + path).status, 0) << each.name;
  }
}

}  // namespace
}  // namespace rehearse::policy
