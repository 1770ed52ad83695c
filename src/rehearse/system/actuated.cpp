#include "rehearse/system/actuated.hpp"

#include <utility>

namespace rehearse::system {
namespace {

class ActuatedSimulator final : public Simulator {
 public:
  ActuatedSimulator(std::shared_ptr<const Simulator> robot, Actuators actuators)
      : robot_(std::move(robot)), actuators_(std::move(actuators)) {}

  const ParameterSpace& parameters() const override { return robot_->parameters(); }
  Index rows_at_once() const override { return robot_->rows_at_once(); }
  std::shared_ptr<const Simulator> behind_actuators() const override { return robot_; }

  void change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) const override {
    thread_local Matrix moving;
    moving.resize(U.rows(), U.cols());
    actuators_.moving(X, U, moving);
    const Index own = actuators_.own_states(), memory = actuators_.memory();
    actuators_.remember(X, U, dX);
    dX.rightCols(memory) -= X.rightCols(memory);
    robot_->change(X.leftCols(own), moving, phi, dX.leftCols(own));
  }

 private:
  std::shared_ptr<const Simulator> robot_;
  Actuators actuators_;
};

class ActuatedPlant final : public Plant {
 public:
  ActuatedPlant(std::unique_ptr<Plant> robot, Actuators task, Actuators own)
      : robot_(std::move(robot)), task_{std::move(task), {}}, own_{std::move(own), {}} {}

  Vector reset(Rng& rng) override {
    task_.start(), own_.start();
    return with_memory(robot_->reset(rng));
  }

  Vector step(const Vector& u) override {
    const Matrix U = u.transpose();
    Matrix moving(1, u.size());
    own_.actuators.moving(own_.states, U, moving);
    const Vector measured = robot_->step(moving.transpose());
    task_.step(U), own_.step(U);
    return with_memory(measured);
  }

  bool ended() const override { return robot_->ended(); }
  void finish() noexcept override { robot_->finish(); }
  void require_finished() override { robot_->require_finished(); }
  Vector truth() const override { return with_memory(robot_->truth()); }

 private:
  struct Remembered {
    Actuators actuators;
    Matrix states;  // 1 × states, of which the memory alone is known

    void start() {
      states = Matrix::Zero(1, actuators.states());
      states.rightCols(actuators.memory()) = actuators.start().transpose();
    }
    void step(const Matrix& commands) {
      Matrix next = states;
      actuators.remember(states, commands, next);
      states = std::move(next);
    }
  };

  /// The robot's own state with the task's memory behind it; an empty one stays empty: it is not known.
  Vector with_memory(Vector own) const {
    if (own.size() == 0) return own;
    const Index states = own.size(), memory = task_.actuators.memory();
    own.conservativeResize(states + memory);
    own.tail(memory) = task_.states.rightCols(memory).transpose();
    return own;
  }

  std::unique_ptr<Plant> robot_;
  Remembered task_, own_;
};

}  // namespace

std::shared_ptr<const Simulator> with_actuators(std::shared_ptr<const Simulator> robot, Actuators actuators) {
  return std::make_shared<ActuatedSimulator>(std::move(robot), std::move(actuators));
}

std::unique_ptr<Plant> with_actuators(std::unique_ptr<Plant> robot, Actuators task, Actuators own) {
  return std::make_unique<ActuatedPlant>(std::move(robot), std::move(task), std::move(own));
}

}  // namespace rehearse::system
