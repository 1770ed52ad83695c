#include "rehearse/system/program_simulator.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/turns.hpp"
#include "rehearse/system/conversation.hpp"

namespace rehearse::system {
namespace {

constexpr Index kPatience = 24;  // faults in a row

class ProgramWorker final : public Worker {
 public:
  explicit ProgramWorker(const Program& program) : conversation_(program) {}

  Index change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) override {
    if (!began_ && !conversation_.problem().empty()) return 0;
    began_ = true;
    for (Index done = 0; done < X.rows(); done += Conversation::kMostRows) {
      const Index rows = std::min(Conversation::kMostRows, X.rows() - done);
      if (!conversation_.change(X.middleRows(done, rows), U.middleRows(done, rows), phi, dX.middleRows(done, rows)))
        return done;
    }
    return X.rows();
  }

  std::string problem() const override { return conversation_.problem(); }
  bool declined() const override { return began_ && conversation_.declined(); }
  bool costly() const override { return !began_ || conversation_.late(); }
  void leave() noexcept override { conversation_.leave(); }

 private:
  Conversation conversation_;
  bool began_ = false;
};

/// The finite rows of a batch; others are not sent: many programs would end.
class FiniteRows {
 public:
  FiniteRows(const ConstMatrixView& X, const ConstMatrixView& U) {
    for (Index i = 0; i < X.rows(); ++i)
      if (X.row(i).allFinite() && U.row(i).allFinite()) rows_.push_back(i);
  }
  bool all(Index rows) const { return static_cast<Index>(rows_.size()) == rows; }
  Matrix of(const ConstMatrixView& rows) const { return rows(rows_, Eigen::all); }
  void scatter(const Matrix& dX, MatrixView all) const {
    all.setConstant(kNaN);
    all(rows_, Eigen::all) = dX;
  }

 private:
  std::vector<Index> rows_;
};

/// A robot that keeps its own state, as a program does that can reset and step.
class EpisodePlant final : public Plant {
 public:
  /// conversation: with the program, which is started once.
  EpisodePlant(const Program& program, std::unique_ptr<Conversation> conversation, Vector phi, StartAndSensors around)
      : program_(program),
        phi_(std::move(phi)),
        around_(std::move(around)),
        turns_(around_.angles, around_.start_mean),
        conversation_(std::move(conversation)) {}

  Vector reset(Rng& rng) override {
    require_finished();
    const Vector start = around_.start(rng);
    const auto seed = static_cast<std::uint64_t>(rng.uniform() * 0x1p53);
    rng_ = rng;
    turns_.begin();
    if (!conversation_) conversation_ = std::make_unique<Conversation>(program_);
    if (!conversation_->problem().empty()) fail();
    return seen(conversation_->reset(start, phi_, seed));
  }

  Vector step(const Vector& u) override {
    if (!rng_ || !conversation_) throw std::logic_error("the plant makes a step before it was reset");
    return seen(conversation_->step(u));
  }

  void finish() noexcept override try {
    if (!conversation_ || conversation_->end()) return;
    not_ended(conversation_->problem().c_str());
  } catch (const std::exception& error) {
    not_ended(error.what());
  } catch (...) {
    not_ended("it is not known why");
  }

  void require_finished() override {
    if (not_ended_.empty()) return;
    throw Unavailable(
        fmt::format("the message \"end\" of the last episode, at which the robot's torque is taken off, was not "
                    "answered well: {}",
                    std::exchange(not_ended_, {})));
  }

  Vector truth() const override { return truth_; }

 private:
  Vector seen(const std::optional<messages::State>& answer) {
    if (!answer) fail();
    const Vector measured = turns_.counted(answer->measured);
    truth_ = turns_.beside(answer->truth, measured);
    return around_.measured(measured, *rng_);
  }

  void not_ended(const char* why) noexcept {
    try {
      not_ended_ = why;
    } catch (const std::bad_alloc&) {  // the next reset says nothing
    }
    conversation_.reset();
  }

  [[noreturn]] void fail() {
    const std::string problem = conversation_->problem();
    if (conversation_->declined()) finish();  // the program goes on, and so may the robot
    conversation_.reset();                    // the next episode begins with another process
    throw Unavailable(problem);
  }

  Program program_;
  Vector phi_;
  StartAndSensors around_;
  Turns turns_;
  std::unique_ptr<Conversation> conversation_;  // null: the last one failed
  std::string not_ended_;                       // why the last episode's end was not answered well
  std::optional<Rng> rng_;
  Vector truth_;
};

/// Throws InvalidInput where the program cannot be spoken with.
std::unique_ptr<Conversation> begun(const Program& program) {
  auto conversation = std::make_unique<Conversation>(program);
  if (!conversation->problem().empty()) throw InvalidInput(conversation->problem());
  return conversation;
}

std::string no_next_state(const Program& program, const Vector& x, const Vector& u) {
  return fmt::format("the program '{}' has no next state (null) for the state [{:.6g}] and the action [{:.6g}]",
                     fmt::join(program.command, " "), fmt::join(x, ", "), fmt::join(u, ", "));
}

}  // namespace

ProgramSimulator::ProgramSimulator(Program program, ParameterSpace parameters)
    : parameters_(std::move(parameters)),
      workers_({.start = [program = std::move(program)] { return std::make_unique<ProgramWorker>(program); },
                .patience = kPatience}) {}

void ProgramSimulator::change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi,
                              MatrixView dX) const {
  check_sizes(*this, X, U, phi, dX);
  const FiniteRows finite(X, U);
  if (finite.all(X.rows())) return workers_.change(X, U, phi.head(parameters_.size()), dX);
  const Matrix some = finite.of(X);
  Matrix changes(some.rows(), X.cols());
  workers_.change(some, finite.of(U), phi.head(parameters_.size()), changes);
  finite.scatter(changes, dX);
}

std::unique_ptr<Plant> make_program_plant(const Program& program, const ParameterSpace& phi,
                                          const StartAndSensors& around,
                                          std::shared_ptr<const ProgramSimulator> simulator) {
  if (auto conversation = begun(program); conversation->has_episodes())
    return std::make_unique<EpisodePlant>(program, std::move(conversation), phi.values(), around);
  if (!simulator) simulator = std::make_shared<ProgramSimulator>(program, phi);
  const auto motion = [simulator, program, phi = phi.values()](const Vector& x, const Vector& u) -> Vector {
    Matrix dX(1, x.size());
    const Index faults = simulator->faults().count;
    simulator->change(x.transpose(), u.transpose(), phi, dX);
    if (!dX.allFinite())
      throw std::runtime_error(simulator->faults().count > faults ? simulator->faults().last
                                                                  : no_next_state(program, x, u));
    return x + dX.row(0).transpose();
  };
  return make_simulated_plant(motion, around);
}

void require_program(const Program& program, ProgramUse use) {
  const auto conversation = begun(program);
  if (use == ProgramUse::simulator && !conversation->require_changes()) throw InvalidInput(conversation->problem());
}

}  // namespace rehearse::system
