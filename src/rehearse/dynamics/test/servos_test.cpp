#include "rehearse/dynamics/servos.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/identification/learn.hpp"
#include "rehearse/system/simulator.hpp"
#include "swing.hpp"

namespace rehearse::dynamics {
namespace {

using swing::rms;

// Two servos push a cart with their joints: states q1, q2, their speeds, and the cart's x, which moves by gain · (Δq1 +
// 2 Δq2). The simulator's servos reach their targets at once, the real ones are slow and heavy, of one type or of two.
constexpr double kStep = 0.1, kGain = 0.5, kPush[] = {1, 2};

double slow(double way, double speed) { return 0.25 * std::tanh(way / 0.3) + 0.03 * speed; }

double pushed(const Vector& moved) { return kGain * (kPush[0] * moved(0) + kPush[1] * moved(1)); }

Kinematics kinematics(Index second_type = 0) {
  return {.dt_s = kStep,
          .pairs = {{.position = 0, .rate = 2}, {.position = 1, .rate = 3}},
          .servos = {{.action = 0, .position = 0, .rate = 2, .type = 0},
                     {.action = 1, .position = 1, .rate = 3, .type = second_type}}};
}

FeatureMap features() {
  using enum StateKind;
  return FeatureMap({plain, plain, plain, plain, omitted}, {}, {0, 1});
}

/// A prior of perfect servos with a tunable gain.
prior::Prior perfect_servos(double gain = kGain) {
  const ParameterSpace space({Parameter::continuous("gain", gain, {0.1, 2})});
  const auto change = [](const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) {
    dX.leftCols(2) = U - X.leftCols(2);
    dX.middleCols(2, 2) = -X.middleCols(2, 2);
    dX.col(4) = phi(0) * (dX.col(0) * kPush[0] + dX.col(1) * kPush[1]);
  };
  return {"perfect", system::make_simulator(space, change), space};
}

struct Ways {
  double first = 1, second = 1;  // how far targets are at most
};

/// n independent steps; `dead`: the second servo does not move.
Dataset steps(Index n, std::uint64_t seed, Ways ways = {}, bool dead = false) {
  Rng rng({.seed = seed});
  Dataset data{.states = Matrix(n, 5), .actions = Matrix(n, 2), .changes = Matrix(n, 5), .rewards = Vector::Zero(n)};
  for (Index i = 0; i < n; ++i) {
    for (Index s = 0; s < 5; ++s) data.states(i, s) = rng.uniform(-1, 1);
    if (dead) data.states(i, 3) = 0;
    Vector moved(2);
    for (Index j = 0; j < 2; ++j) {
      const double most = j == 0 ? ways.first : ways.second, way = rng.uniform(-most, most);
      data.actions(i, j) = data.states(i, j) + way;
      moved(j) = dead && j == 1 ? 0 : slow(way, data.states(i, 2 + j));
      data.changes(i, j) = moved(j);
      data.changes(i, 2 + j) = moved(j) / kStep - data.states(i, 2 + j);
    }
    data.changes(i, 4) = pushed(moved);
  }
  return data;
}

Servos servos_of(const Dataset& data, Index second_type = 0) {
  return {data, features(), kinematics(second_type).servos, identification::ResidualGpOptions(), serial_evaluator()};
}

/// The error of joint j's position and speed at the end of a step, as a fraction of its motion.
double error_of(const Servos& servos, const Dataset& data, Index j) {
  Servos::End end;
  servos.means(data.states, data.actions, end);
  const Matrix next = data.states + data.changes;
  return (rms(end.positions.col(j) - next.col(j)) + kStep * rms(end.speeds.col(j) - next.col(2 + j))) /
         rms(data.changes.col(j));
}

TEST(Servos, LearnWhereTheyGetToAndHowFastTheyAreThen) {
  const Servos servos = servos_of(steps(30, 1));
  const Dataset held_out = steps(200, 2);
  for (Index j = 0; j < 2; ++j) EXPECT_LT(error_of(servos, held_out, j), 0.05);
}

TEST(Servos, ThoseOfAMakeLearnFromEachOther) {
  const Dataset hardly = steps(30, 1, {.first = 1, .second = 0.1}), held_out = steps(200, 2);
  EXPECT_LT(error_of(servos_of(hardly), held_out, 1), 0.05);
  EXPECT_GT(error_of(servos_of(hardly, 1), held_out, 1), 0.2) << "of another type";
}

TEST(Servos, ADeadOneStaysWhereItIsAndMisleadsNoOther) {
  const Dataset data = steps(30, 1, {}, true), held_out = steps(200, 2, {}, true);
  const Servos servos = servos_of(data);
  EXPECT_LT(error_of(servos, held_out, 0), 0.05);
  Servos::End end;
  servos.predict(held_out.states, held_out.actions, end);
  EXPECT_EQ(end.positions.col(1), held_out.states.col(1));
  EXPECT_EQ(end.speeds.col(1), Vector::Zero(200));
  EXPECT_EQ(end.position_variances.col(1), Vector::Zero(200));
}

TEST(Servos, OfManyRowsSomeAreEnough) {
  const Servos servos = servos_of(steps(400, 1));
  EXPECT_LT(error_of(servos, steps(200, 2), 0), 0.05);
}

TEST(Servos, ARowThatIsNotFiniteIsNaNAlone) {
  const Servos servos = servos_of(steps(30, 1));
  Dataset held_out = steps(3, 2);
  held_out.states(1, 0) = kNaN;
  Servos::End end;
  servos.predict(held_out.states, held_out.actions, end);
  EXPECT_TRUE(std::isnan(end.positions(1, 0)));
  EXPECT_TRUE(end.positions.row(0).allFinite() && end.positions.row(2).allFinite());
}

TEST(Servos, NeedData) { EXPECT_THROW(servos_of(steps(0, 1)), InvalidInput); }

double error_of_x(const Dataset& data, const identification::Kind& kind, const prior::Prior& prior) {
  const identification::Learned learned =
      identification::learn({data, features(), kinematics(), &prior}, kind, {}, serial_evaluator());
  const Dataset held_out = steps(200, 2);
  Matrix mean(200, 5), variance(200, 5);
  learned.model->predict(held_out.states, held_out.actions, mean, variance);
  EXPECT_GE(variance.minCoeff(), 0);
  Matrix mean_alone(200, 5);
  learned.model->predict_mean(held_out.states, held_out.actions, mean_alone);
  EXPECT_LT((mean - mean_alone).cwiseAbs().maxCoeff(), 1e-9);
  return rms(mean.col(4) - held_out.changes.col(4)) / rms(held_out.changes.col(4));
}

TEST(ServoModel, KnowsWhatFollowsFromWhereServosGetTo) {
  const Dataset data = steps(15, 1);
  identification::GpMi without;
  without.gp.servos = false;
  // Eight such data sets: at most 0.006 with servos, 0.21 to 0.48 without.
  EXPECT_LT(error_of_x(data, identification::GpMi{}, perfect_servos()), 0.02);
  EXPECT_GT(error_of_x(data, without, perfect_servos()), 0.2);
}

TEST(ServoModel, AsksWhatFollowsFromJointsThatAreDriven) {
  const Dataset data = steps(15, 1);
  prior::Prior jerky = perfect_servos();
  jerky.driven = jerky.simulator;
  jerky.simulator = system::make_simulator(
      jerky.space,
      [driven = jerky.driven](const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) {
        driven->change(X, U, phi, dX);
        dX.col(4) = (20 * dX.col(4)).array().sin().matrix();
      });
  EXPECT_LT(error_of_x(data, identification::FixedPrior{}, jerky), 0.1);
  jerky.driven = nullptr;
  EXPECT_GT(error_of_x(data, identification::FixedPrior{}, jerky), 0.3);
}

TEST(ServoModel, ADrawOfServosMovesTheRobotWithThem) {
  Dataset data = steps(40, 1), held_out = steps(50, 2);
  Rng rng({.seed = 3});
  for (Index i = 0; i < data.size(); ++i) {  // what servos do is noisy, and what follows from it is not
    const double more = 0.05 * rng.normal();
    data.changes(i, 0) += more;
    data.changes(i, 4) += kGain * kPush[0] * more;
  }
  const prior::Prior prior = perfect_servos();
  identification::FixedPrior kind;
  kind.gp.variance = PredictedVariance::noisy;
  const identification::Learned learned =
      identification::learn({data, features(), kinematics(), &prior}, kind, {}, serial_evaluator());
  const Matrix normals = Matrix::NullaryExpr(50, 5, [&] { return rng.normal(); });
  Matrix drawn(50, 5), mean(50, 5), variance(50, 5);
  learned.model->sample(held_out.states, held_out.actions, normals, drawn);
  learned.model->predict(held_out.states, held_out.actions, mean, variance);
  EXPECT_GT(rms(drawn.col(0) - mean.col(0)), 0.02);
  EXPECT_LT((drawn.col(0) - mean.col(0) - normals.col(0).cwiseProduct(variance.col(0).cwiseSqrt())).norm(), 1e-12);
  for (Index i = 0; i < 50; ++i) EXPECT_NEAR(drawn(i, 4), pushed(drawn.row(i).head(2)), 0.01);
}

TEST(ServoModel, ParametersAreIdentifiedFromWhatFollows) {
  const Dataset data = steps(15, 1);
  for (const identification::Score score : {identification::Score::product, identification::Score::sum}) {
    identification::GpMi kind;
    kind.score = score;
    const prior::Prior wrong = perfect_servos(1.2);
    const identification::Learned learned =
        identification::learn({data, features(), kinematics(), &wrong}, kind, {}, serial_evaluator());
    EXPECT_NEAR((*learned.state.phi)(0), kGain, 1e-3);
    EXPECT_TRUE(std::isfinite(*learned.log_evidence));
  }
}

}  // namespace
}  // namespace rehearse::dynamics
