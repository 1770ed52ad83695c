#include <optional>

#include <gtest/gtest.h>

#include "exported_fixture.hpp"

namespace rehearse::policy {
namespace {

namespace fs = std::filesystem;

using exports::Case, exports::Ran, exports::run;

constexpr Index kManyRows = 100'000, kEmulatedRows = 10'000;

const std::string kWarnings = " -Wall -Wextra -pedantic -Werror";

/// Ways to compile C and C++, of those that this machine has.
std::vector<std::string> compilers(const std::vector<std::string>& wanted) {
  std::vector<std::string> there;
  exports::write(test_folder() / "empty.c", "#include <math.h>\nint main(void) { return 0; }\n");
  for (const std::string& compiler : wanted)
    if (run(compiler + " " + (test_folder() / "empty.c").string() + " -o " + (test_folder() / "empty").string())
            .status == 0)
      there.push_back(compiler + kWarnings);
  return there;
}

/// Reads states and times, writes actions; fails where something is invalid, overflows or is divided by zero.
constexpr const char* kProgram = R"(#include <fenv.h>
#include <stdio.h>
#include "one.h"
#include "two.h"
int main(void) {
  double in[ONE_STATES + 1], u[ONE_ACTIONS], again[TWO_ACTIONS];
  while (fread(in, sizeof in, 1, stdin) == 1) {
    feclearexcept(FE_ALL_EXCEPT);
    if (one_act(in, in[ONE_STATES], u) != two_act(in, in[ONE_STATES], again)) return 1;
    if (fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW)) return 2;
    if (fwrite(u, sizeof u, 1, stdout) != 1) return 3;
  }
  return 0;
}
)";

void write_policy(const fs::path& folder, const Exported& exported) {
  exports::write(folder / "one.h", to_c(exported, "one"));
  exports::write(folder / "two.h", to_c(exported, "two"));
}

/// The program's answers.
Matrix answers_of(const std::string& runner, const fs::path& program, const Answers& asked, Index actions) {
  const fs::path in = program.parent_path() / "in", out = program.parent_path() / "out";
  exports::write(in, exports::bytes_of(asked));
  const Ran ran = run("( " + runner + program.string() + " <" + in.string() + " >" + out.string() + " )");
  EXPECT_EQ(ran.status, 0) << ran.output;
  return exports::from_bytes(exports::read(out), actions);
}

/// Compiled without a warning in each of these ways, it does what the policy does.
void check_compiled(const Case& of, const std::vector<std::string>& ways, Index rows, const std::string& runner = "") {
  const fs::path folder = test_folder(), program = folder / "program";
  const Exported many = exports::exported(of, exports::asked(rows, of.task.dt_s));
  const Index actions = many.answers.actions.cols();
  write_policy(folder, exports::exported(of, exports::asked(8, of.task.dt_s)));
  exports::write(folder / "program.c", kProgram);
  for (const std::string& way : ways) {
    const Ran compiled = run(way + " " + (folder / "program.c").string() + " -o " + program.string() + " -lm");
    ASSERT_TRUE(compiled.status == 0 && compiled.output.empty()) << of.name << ": " << way << "\n" << compiled.output;
    EXPECT_LE(exports::apart(many, answers_of(runner, program, many.answers, actions)), 1e-12)
        << of.name << ": " << way;
    exports::check_hostile(of, exports::hostile(), answers_of(runner, program, exports::hostile(), actions));
  }
}

TEST(ExportedC, IsThePolicy) {
  const auto ways =
      compilers({"gcc -std=c99 -O2", "g++ -x c++ -O2", "clang -std=c99 -O2 -ffp-exception-behavior=strict"});
  if (ways.empty()) GTEST_SKIP() << "there is no compiler";
  for (const Case& each : exports::cases()) check_compiled(each, ways, kManyRows);
}

/// The runner of 32-bit programs: "" if they run by themselves, or an emulator; none if neither works.
std::optional<std::string> runner_of_32_bit(const std::string& compiler) {
  const std::string program = (test_folder() / "empty").string();
  run(compiler + " " + (test_folder() / "empty.c").string() + " -o " + program);
  for (const std::string runner : {"", "qemu-i386 "})
    if (run(runner + program).status == 0) return runner;
  return {};
}

TEST(ExportedC, IsThePolicyOn32BitToo) {
  const auto ways = compilers({"gcc -std=c99 -m32 -O2", "gcc -std=c99 -m32 -O2 -msse2 -mfpmath=sse"});
  const auto runner = ways.empty() ? std::nullopt : runner_of_32_bit(ways.front());
  if (!runner) GTEST_SKIP() << "there is no compiler for 32 bit (gcc-multilib), or nothing that runs what it makes";
  for (const Case& each : exports::cases()) check_compiled(each, ways, kEmulatedRows, *runner);
}

TEST(ExportedC, TestsItself) {
  const auto ways = compilers({"gcc -std=c99", "g++ -x c++"});
  if (ways.empty()) GTEST_SKIP() << "there is no compiler";
  const std::string program = (test_folder() / "itself").string();
  for (const Case& each : exports::cases())
    for (const std::string& way : ways) {
      const auto status = [&](const Exported& exported) {
        exports::write(test_folder() / "itself.h", to_c(exported, "itself"));
        const std::string language = way.starts_with("gcc") ? " -x c " : " ";
        const Ran compiled = run(way + " -DREHEARSE_POLICY_MAIN" + language + (test_folder() / "itself.h").string() +
                                 " -o " + program + " -lm");
        EXPECT_TRUE(compiled.status == 0 && compiled.output.empty()) << way << "\n" << compiled.output;
        return run(program).status;
      };
      Exported exported = exports::exported(each, exports::asked(8, each.task.dt_s));
      EXPECT_EQ(status(exported), 0) << each.name;
      if (way != ways.front()) continue;  // the same source is as wrong for every compiler
      exported.answers.actions(3, 1) += 1e-6;
      EXPECT_NE(status(exported), 0) << each.name;
    }
}

// REHEARSE_POLICY_MAIN asks for the test, and must not be what a policy of that name is guarded by.
TEST(ExportedC, MayBeCalledMain) {
  const auto ways = compilers({"gcc -std=c99"});
  if (ways.empty()) GTEST_SKIP() << "there is no compiler";
  exports::write(test_folder() / "main.h",
                 to_c(exports::exported(exports::cases().front(), exports::asked(2, 0.1)), "main"));
  exports::write(test_folder() / "uses.c", "#include \"main.h\"\nint main(void) { return MAIN_ACTIONS == 0; }\n");
  const Ran compiled = run(ways.front() + " " + (test_folder() / "uses.c").string() + " -o " +
                           (test_folder() / "uses").string() + " -lm");
  EXPECT_TRUE(compiled.status == 0 && compiled.output.empty()) << compiled.output;
}

TEST(ExportedC, NamesThatEndCommentsDoNoHarm) {
  const auto ways = compilers({"gcc -std=c99"});
  if (ways.empty()) GTEST_SKIP() << "there is no compiler";
  Case of = exports::cases().front();
  of.task.states[0] = {"v */ int x; /* \\",
                       "m/s ?"
                       "?/\n#error"};
  exports::write(test_folder() / "hostile.h", to_c(exports::exported(of, exports::asked(2, 0.1)), "hostile"));
  const Ran compiled = run(ways.front() + " -c -x c " + (test_folder() / "hostile.h").string() + " -o " +
                           (test_folder() / "hostile.o").string());
  EXPECT_TRUE(compiled.status == 0 && compiled.output.empty()) << compiled.output;
}

}  // namespace
}  // namespace rehearse::policy
