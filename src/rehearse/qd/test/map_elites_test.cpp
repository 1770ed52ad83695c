#include "rehearse/qd/map_elites.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/qd/archive_bytes.hpp"
#include "square_archive.hpp"

namespace rehearse::qd {
namespace {

/// Performance −‖x‖², descriptors the first two parameters: the best of a niche is where the others are 0.
void bowl(const ConstMatrixView& X, std::uint64_t, VectorView performances, MatrixView descriptors) {
  for (Index i = 0; i < X.rows(); ++i) performances(i) = -X.row(i).squaredNorm();
  descriptors = X.leftCols(2);
}

MapElites search(const MapElitesOptions& options = {.batch = 100, .initial = 200}, std::uint64_t seed = 1,
                 Index bins = 10) {
  return {square_archive(bins), {.box = std::vector<Interval>(5, {-1, 1})}, options, {.seed = seed}};
}

std::string bytes_of(const MapElites& search) {
  return to_bytes({search.archive(), search.evaluations(), search.failed(), ""});
}

void run(MapElites& search, int generations, const Evaluate& evaluate = bowl,
         const Evaluator& evaluator = serial_evaluator()) {
  for (int g = 0; g < generations; ++g) search.step(evaluate, evaluator);
}

TEST(MapElites, FillsTheArchiveAndImprovesIt) {
  for (const auto kind : {Variation::Kind::iso_line, Variation::Kind::gaussian, Variation::Kind::reset}) {
    MapElitesOptions options{.batch = 100, .initial = 200};
    options.variation = {.kind = kind, .iso_sigma = 0.05};
    MapElites searching = search(options);
    run(searching, 2);
    const Statistics first = searching.archive().statistics(-5);
    run(searching, 198);
    const Statistics last = searching.archive().statistics(-5);
    EXPECT_EQ(searching.evaluations(), 20000U);
    EXPECT_LT(first.coverage, 0.95) << static_cast<int>(kind);
    EXPECT_EQ(last.coverage, 1) << static_cast<int>(kind);
    // The best of a niche is its point nearest to 0: ‖x‖² is 0.48 on average, and 0.68 of points spread evenly.
    EXPECT_GT(last.qd_score, 100 * (5 - 0.56)) << static_cast<int>(kind);
    EXPECT_LT(last.qd_score, 100 * (5 - 0.48)) << static_cast<int>(kind);
    EXPECT_GT(last.best, -0.01) << static_cast<int>(kind);
  }
}

TEST(MapElites, IsTheSameOnAnyNumberOfThreadsAndByHand) {
  for (const Index batch : {1, 63, 64, 200}) {
    MapElites one = search({.batch = batch, .initial = 150}), two = one, by_hand = one;
    const auto threads = make_thread_evaluator(3);
    run(one, 12);
    run(two, 12, bowl, *threads);
    for (int g = 0; g < 12; ++g) {
      const Matrix& X = by_hand.ask();
      EXPECT_EQ(&X, &by_hand.ask());
      Vector performances(batch);
      Matrix descriptors(batch, 2);
      bowl(X, 0, performances, descriptors);
      by_hand.tell(performances, descriptors);
    }
    EXPECT_EQ(bytes_of(one), bytes_of(two)) << batch;
    EXPECT_EQ(bytes_of(one), bytes_of(by_hand)) << batch;
  }
  MapElites one = search(), other = search({.batch = 100, .initial = 200}, 2);
  run(one, 3);
  run(other, 3);
  EXPECT_NE(bytes_of(one), bytes_of(other));
}

TEST(MapElites, GoesOnFromWhatWasKept) {
  MapElites whole = search();
  run(whole, 6);
  const std::string kept = bytes_of(whole);
  run(whole, 6);
  MapElites resumed = search();
  Search back = from_bytes(kept, "kept");
  resumed.resume(std::move(back.archive), back.evaluations, back.failed);
  run(resumed, 6);
  EXPECT_EQ(bytes_of(resumed), bytes_of(whole));
  EXPECT_THROW(resumed.resume(square_archive(11), 0, 0), InvalidInput);
  EXPECT_THROW(resumed.resume(square_archive(10, 4), 0, 0), InvalidInput);
}

TEST(MapElites, AnInterruptedGenerationLeavesNoTrace) {
  MapElites searching = search();
  run(searching, 3);
  const std::string before = bytes_of(searching);
  const auto throws = [](const ConstMatrixView& X, std::uint64_t first, VectorView p, MatrixView d) {
    bowl(X, first, p, d);
    if (first % 100 != 0) throw std::runtime_error("stop");
  };
  EXPECT_THROW(run(searching, 1, throws), std::runtime_error);
  EXPECT_EQ(bytes_of(searching), before);
}

// A third of all has no performance, a third no descriptor.
TEST(MapElites, CountsFailuresAndKeepsNone) {
  const auto failing = [](const ConstMatrixView& X, std::uint64_t first, VectorView performances,
                          MatrixView descriptors) {
    bowl(X, first, performances, descriptors);
    for (Index i = 0; i < X.rows(); ++i) {
      const auto number = first + static_cast<std::uint64_t>(i);
      if (number % 3 == 1) performances(i) = std::nan("");
      if (number % 3 == 2) descriptors(i, 1) = kInf;
    }
  };
  MapElites searching = search({.batch = 99, .initial = 99});
  run(searching, 10, failing);
  EXPECT_EQ(searching.evaluations(), 990U);
  EXPECT_EQ(searching.failed(), 660U);
  EXPECT_GT(searching.archive().size(), 0);

  MapElites hopeless = search({.batch = 10, .initial = 10});
  run(hopeless, 5, [](const ConstMatrixView&, std::uint64_t, VectorView performances, MatrixView descriptors) {
    performances.setConstant(std::nan(""));
    descriptors.setZero();
  });
  EXPECT_EQ(hopeless.failed(), 50U);
  EXPECT_EQ(hopeless.archive().size(), 0);
}

TEST(MapElites, AShareOfTheFirstSolutionsIsNearTheExamples) {
  const MapElitesOptions options{.batch = 2000, .initial = 2000, .examples = 0.25, .example_sigma = 0.01};
  Matrix examples(2, 5);
  examples << Vector::Constant(5, 0.5).transpose(), Vector::Constant(5, -1).transpose();
  const std::vector<Interval> box(5, {-1, 1});
  MapElites with(square_archive(), {.box = box, .examples = examples}, options, {.seed = 1});
  MapElites without(square_archive(), {.box = box}, options, {.seed = 1});
  const Matrix X = with.ask(), uniform = without.ask();
  Index near[2] = {0, 0}, same = 0;
  for (Index i = 0; i < X.rows(); ++i) {
    same += X.row(i) == uniform.row(i);
    for (Index e = 0; e < 2; ++e) near[e] += (X.row(i) - examples.row(e)).cwiseAbs().maxCoeff() < 5 * 0.02;
  }
  EXPECT_NEAR(static_cast<double>(near[0]), 250, 60);
  EXPECT_NEAR(static_cast<double>(near[1]), 250, 60);
  EXPECT_EQ(near[0] + near[1] + same, X.rows()) << "the others are as without examples";
  EXPECT_LE(X.cwiseAbs().maxCoeff(), 1);
}

TEST(MapElites, StaysInItsBoxOrGoesAnywhere) {
  MapElitesOptions options{.batch = 100, .initial = 100};
  options.variation.iso_sigma = 0.5;
  const auto largest = [&](std::vector<Interval> box) {
    MapElites searching(square_archive(), {.box = std::move(box), .start = Vector::Constant(5, 0.9)}, options,
                        {.seed = 1});
    double most = 0;
    for (int g = 0; g < 20; ++g) {
      most = std::max(most, searching.ask().cwiseAbs().maxCoeff());
      searching.step(bowl, serial_evaluator());
    }
    return most;
  };
  EXPECT_EQ(largest(std::vector<Interval>(5, {-1, 1})), 1);
  EXPECT_GT(largest({}), 1.5);
}

TEST(MapElites, RefusesWrongInputByName) {
  const auto refusal = [](SearchSpace space, MapElitesOptions options) -> std::string {
    try {
      MapElites(square_archive(), std::move(space), options, {});
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return {};
  };
  const std::vector<Interval> box(5, {-1, 1});
  EXPECT_EQ(refusal({.box = box}, {}), "");
  EXPECT_EQ(refusal({}, {}), "there must be a box or a start");
  EXPECT_EQ(refusal({.box = {{0, 1}}}, {}), "the box has 1 sides, must have 5");
  EXPECT_EQ(refusal({.start = Vector::Zero(4)}, {}), "the start must have 5 finite parameters");
  EXPECT_EQ(refusal({.start = Vector::Zero(5)}, {.variation = {.kind = Variation::Kind::reset}}),
            "variation.kind = reset needs a box");
  EXPECT_NE(refusal({.box = box}, {.batch = 0, .variation = {.iso_sigma = -1}}).find("batch = 0"), std::string::npos);
  MapElites searching = search();
  EXPECT_THROW(searching.tell(Vector::Zero(99), Matrix::Zero(100, 2)), InvalidInput);
}

}  // namespace
}  // namespace rehearse::qd
