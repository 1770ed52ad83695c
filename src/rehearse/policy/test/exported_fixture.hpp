#pragma once
// Policies of every kind, and programs that are made of what is written of them.

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "fixture.hpp"
#include "rehearse/core/test/test_tools.hpp"
#include "rehearse/policy/exported.hpp"
#include "rehearse/policy/gait.hpp"
#include "rehearse/policy/hand_over.hpp"
#include "rehearse/policy/network.hpp"
#include "rehearse/policy/rbf.hpp"
#include "rehearse/policy/schedule.hpp"
#include "rehearse/policy/tracking.hpp"

namespace rehearse::policy::exports {

struct Case {
  std::string name;
  Task task;
  std::shared_ptr<const Policy> policy;
  Vector theta;
};

inline Task walker_task() {
  Task task = fixture::task();
  task.actions.clear();
  for (int i = 0; i < 18; ++i) task.actions.push_back({"joint " + std::to_string(i), "rad", {-0.8, 0.8}});
  return task;
}

inline std::vector<Case> cases() {
  const Task task = fixture::task();
  const FeatureMap features = fixture::features();
  const Squash tanh{fixture::kBounds, 5, Squash::Shape::tanh}, sine{fixture::kBounds, 1, Squash::Shape::sine};
  std::vector<Case> all;
  const auto add = [&](const std::string& name, const std::shared_ptr<const Policy>& policy) {
    all.push_back({name, task, policy, fixture::normals(policy->parameters(), 1, 7)});
  };
  add("linear", make_linear({features, fixture::kScale, tanh}));
  add("linear_sine", make_linear({features, fixture::kScale, sine}));
  add("mlp", make_mlp({features, fixture::kScale, 10, tanh}));
  add("rbf", make_rbf({features, fixture::kScale, 10, 0.01, fixture::kBounds}));
  add("schedule", make_schedule(fixture::kBounds, task.dt_s, task.horizon));
  add("tracking", make_tracking(task, task.horizon + 1));
  const auto mlp = make_mlp({features, fixture::kScale, 10, tanh});
  all.push_back({"hand_over", task, make_hand_over(task, mlp),
                 to_theta(fixture::normals(mlp->parameters(), 1, 7), fixture::hand_over())});
  const auto schedule = make_schedule(fixture::kBounds, task.dt_s, task.horizon);
  all.push_back({"schedule_and_near", task, make_hand_over(task, schedule),
                 to_theta(fixture::normals(schedule->parameters(), 1, 7), fixture::hand_over())});
  all.push_back({"gait", walker_task(), make_gait(6), tripod_gait()});
  return all;
}

/// Rows far around the start; times that are control steps, and any.
inline Answers asked(Index rows, double dt_s) {
  Answers asked{.states = 3 * fixture::normals(rows, 3, 5), .times_s = Vector(rows), .actions = {}};
  Rng rng({.seed = 8});
  for (Index i = 0; i < rows; ++i)
    asked.times_s(i) = i % 2 == 0 ? static_cast<double>(i % 400) * dt_s : rng.uniform(0, 30);
  return asked;
}

/// Every entry of a state, and the time, in turn a number that breaks careless programs; then all at once.
inline Answers hostile() {
  using Limits = std::numeric_limits<double>;
  const std::vector<double> numbers = {Limits::quiet_NaN(),
                                       Limits::infinity(),
                                       -Limits::infinity(),
                                       1e300,
                                       -1e300,
                                       Limits::max(),
                                       Limits::lowest(),
                                       1e150,
                                       Limits::denorm_min()};
  const auto count = static_cast<Index>(numbers.size());
  Answers hostile{
      .states = Matrix::Constant(5 * count, 3, 0.5), .times_s = Vector::Constant(5 * count, 0.3), .actions = {}};
  for (Index i = 0; i < count; ++i) {
    const double number = numbers[static_cast<std::size_t>(i)];
    for (Index s = 0; s < 3; ++s) hostile.states(5 * i + s, s) = number;
    hostile.times_s(5 * i + 3) = number;
    hostile.states.row(5 * i + 4).setConstant(number);
  }
  return hostile;
}

inline Exported exported(const Case& of, const Answers& asked) {
  const Origin origin{
      .robot = "slider", .learner = "gp-mi", .prior = "near", .seed = 3, .trial = 2, .total_reward = 4.5};
  return make_exported(origin, of.task, *of.policy, of.theta, asked);
}

inline void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The exit status, and what was printed.
struct Ran {
  int status;
  std::string output;
};

inline Ran run(const std::string& command) {
  const auto said = test_folder() / "said";
  const int status = std::system((command + " >" + said.string() + " 2>&1").c_str());
  return {status, read(said)};
}

/// Rows of state and time, one after the other.
inline std::string bytes_of(const Answers& asked) {
  std::string bytes;
  const auto add = [&](double value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (Index i = 0; i < asked.states.rows(); ++i) {
    for (const double value : asked.states.row(i)) add(value);
    add(asked.times_s(i));
  }
  return bytes;
}

/// Rows of as many numbers.
inline Matrix from_bytes(const std::string& bytes, Index columns) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto count = static_cast<Index>(bytes.size() / sizeof(double));
  std::vector<double> values(static_cast<std::size_t>(count));
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(values.data()));
  return Eigen::Map<const RowMajor>(values.data(), count / columns, columns);
}

/// The largest difference of actions, as a part of half their range.
inline double apart(const Exported& exported, const Matrix& actions) {
  if (actions.rows() != exported.answers.actions.rows()) return kInf;
  double largest = 0;
  for (Index a = 0; a < actions.cols(); ++a) {
    const auto& [low, high] = exported.actions[static_cast<std::size_t>(a)].bounds;
    largest = std::max(largest, (actions.col(a) - exported.answers.actions.col(a)).cwiseAbs().maxCoeff() /
                                    std::max(1.0, (high - low) / 2));
  }
  return largest;
}

/// True if a row is known: all its numbers are finite.
inline bool known(const Answers& asked, Index row) {
  return asked.states.row(row).allFinite() && std::isfinite(asked.times_s(row));
}

/// The law of hostile states: NaN where they are not finite, inside the bounds otherwise.
inline void check_hostile(const Case& of, const Answers& asked, const Matrix& actions) {
  ASSERT_EQ(actions.rows(), asked.states.rows()) << of.name;
  for (Index i = 0; i < actions.rows(); ++i)
    for (Index a = 0; a < actions.cols(); ++a) {
      const auto& [low, high] = of.task.actions[static_cast<std::size_t>(a)].bounds;
      const double u = actions(i, a);
      EXPECT_TRUE(known(asked, i) ? low <= u && u <= high : std::isnan(u)) << of.name << " row " << i << ": " << u;
    }
}

}  // namespace rehearse::policy::exports
