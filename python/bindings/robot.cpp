#include "python/bindings/robot.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "apps/catalogue.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/kept_robot.hpp"
#include "rehearse/robot_file/read.hpp"
#include "rehearse/robot_file/robot_file.hpp"

namespace rehearse::python {
namespace {

/// A call of NumPy costs some 20 µs whatever its rows are, and threads wait for each other.
constexpr Index kRowsAtOnce = 16384;

/// The environment that `make` gives, one thread.
class PythonPlant final : public system::Plant {
 public:
  explicit PythonPlant(const Callable& make) : environment_(make) {
    call_at_once(make, [&](const py::object& function) { environment_.function = shared(function()); });
  }

  Vector reset(Rng& rng) override {
    Vector state;
    const auto seed = static_cast<std::uint32_t>(rng() >> 32);
    ended_ = false;
    call_at_once(environment_, [&](const py::object& it) { state = state_of(it.attr("reset")(seed)); });
    return state;
  }

  Vector step(const Vector& u) override {
    Vector state;
    call_at_once(environment_, [&](const py::object& it) {
      const py::tuple result = it.attr("step")(to_vector(u));
      state = state_of(result[0]);
      ended_ = result[1].cast<bool>();
    });
    return state;
  }

  bool ended() const override { return ended_; }

  void finish() noexcept override {
    try {
      call_at_once(environment_, [](const py::object& it) { it.attr("finish")(); });
    } catch (...) {  // the exception is kept, and ends the work
    }
  }

 private:
  Vector state_of(const py::object& given) const {
    const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
    if (!array || array.ndim() != 1) {
      PyErr_Clear();
      throw py::value_error(environment_.name + ": a state must be an array of one dimension");
    }
    return Vector::Map(array.data(), array.size());
  }

  Callable environment_;
  bool ended_ = false;
};

Reward of_steps(const Callable& of) {
  return [of](const ConstMatrixView& X, const ConstMatrixView& U, const ConstMatrixView& X_next, VectorView values) {
    call(of, [&](const py::object& function) {
      write_result(function(to_array(X), to_array(U), to_array(X_next)), of.name, values);
    });
  };
}

StepCondition limit_of(const Callable& of) {
  return [of](const Steps& steps, VectorView values) {
    call(of, [&](const py::object& function) {
      write_truths(function(to_array(steps.X), to_array(steps.U), to_array(steps.X_next), to_array(steps.U_before),
                            steps.time_s),
                   of.name, values);
    });
  };
}

std::function<double(const Episode&)> of_episodes(const Callable& of) {
  return [of](const Episode& episode) {
    double reward = 0;
    call(of, [&](const py::object& function) {
      reward = number_of(function(to_array(episode.true_states), to_array(episode.actions)), of.name);
    });
    return reward;
  };
}

StateCondition of_states(const Callable& of) {
  return [of](const ConstMatrixView& X, VectorView values) {
    call(of, [&](const py::object& function) { write_truths(function(to_array(X)), of.name, values); });
  };
}

system::Change changes(const Callable& of, const std::vector<std::string>& parameters) {
  return [of, parameters](const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi, MatrixView dX) {
    call(of, [&](const py::object& function) {
      py::dict values;
      for (std::size_t i = 0; i < parameters.size(); ++i) values[py::str(parameters[i])] = phi(static_cast<Index>(i));
      write_result(function(to_array(X), to_array(U), **values), of.name, dX);
    });
  };
}

}  // namespace

Robot::Robot(std::string text, std::string source, std::string folder)
    : text_(std::move(text)), source_(std::move(source)), folder_(std::move(folder)) {
  functions_.rows_at_once = kRowsAtOnce;
}

void Robot::add(Addition addition) {
  addition(functions_, failure_);
  additions_.push_back(std::move(addition));
}

Robot Robot::for_work() const {
  Robot robot(text_, source_, folder_.string());
  for (const Addition& addition : additions_) robot.add(addition);
  return robot;
}

void Robot::add_step_function(const std::string& name, py::object function) {
  add([name, function = shared(std::move(function))](robot_file::Functions& to, const auto& failure) {
    to.of_steps[name] = of_steps({function, name, failure});
  });
}

void Robot::add_step_condition(const std::string& name, py::object function) {
  add([name, function = shared(std::move(function))](robot_file::Functions& to, const auto& failure) {
    to.limits[name] = limit_of({function, name, failure});
  });
}

void Robot::try_out(const scenario::Scenario& scenario) const {
  constexpr Index kRows = 3;
  const Task& task = scenario.task;
  const Index T = task.horizon;
  const Matrix X = task.start_mean.transpose().replicate(kRows, 1), U = Matrix::Zero(kRows, task.action_size());
  Vector values(kRows);
  for (const auto& [name, function] : functions_.of_steps) {
    function(X, U, X, values);
    if (!values.allFinite()) throw InvalidInput(fmt::format("{} is not finite at the start", name));
  }
  for (const auto& [name, function] : functions_.limits) function({X, U, X, U, 0}, values);
  for (const auto& [name, function] : functions_.of_states) function(X, values);
  if (task.ended && holds(task.ended, task.start_mean))
    throw InvalidInput("`ended` holds at the start, so that each episode is over at once");
  const Matrix still = task.start_mean.transpose().replicate(T + 1, 1);
  for (const auto& [name, function] : functions_.of_episodes)
    function({.states = still,
              .true_states = still,
              .actions = Matrix::Zero(T, task.action_size()),
              .rewards = Vector::Zero(T)});
  // The plant's function gets one row, as the plant calls it. Robots with functions have no programs, which may move.
  if (scenario.make_plant && scenario.oracle && !functions_.dynamics.empty()) {
    Matrix dx(1, task.state_size());
    scenario.oracle->change(X.topRows(1), U.topRows(1), scenario.oracle->parameters().values(), dx);
  }
  for (const scenario::NamedPrior& prior : scenario.priors) {
    if (!functions_.dynamics.contains(prior.name)) continue;
    Matrix dX(kRows, task.state_size());
    prior.simulator->change(X, U, prior.parameters.values(), dX);
    if (!dX.allFinite())
      throw InvalidInput(fmt::format("prior {} changes the start by what is not finite", prior.name));
  }
}

void Robot::add_state_function(const std::string& name, py::object function) {
  add([name, function = shared(std::move(function))](robot_file::Functions& to, const auto& failure) {
    to.of_states[name] = of_states({function, name, failure});
  });
}

void Robot::add_episode_function(const std::string& name, py::object function) {
  add([name, function = shared(std::move(function))](robot_file::Functions& to, const auto& failure) {
    to.of_episodes[name] = of_episodes({function, name, failure});
  });
}

void Robot::add_dynamics(const std::string& name, py::object function, const std::vector<std::string>& parameters) {
  add([name, function = shared(std::move(function)), parameters](robot_file::Functions& to, const auto& failure) {
    to.dynamics[name] = changes({function, name, failure}, parameters);
  });
}

void Robot::add_plant(const std::string& name, py::object make) {
  add([name, make = shared(std::move(make))](robot_file::Functions& to, const auto& failure) {
    to.plants[name] = [of = Callable{make, name, failure}] { return std::make_unique<PythonPlant>(of); };
  });
}

experiment::Catalogue Robot::catalogue() const { return catalogue(functions_); }

experiment::Catalogue Robot::to_look() const {
  robot_file::Functions functions = functions_;
  functions.only_look = true;
  return catalogue(functions);
}

experiment::Catalogue Robot::catalogue(const robot_file::Functions& functions) const {
  experiment::Catalogue catalogue = apps::catalogue();
  catalogue.read_robot = [functions](std::string_view text, const std::string& source,
                                     const scenario::ReadFile& read_file) {
    return robot_file::maker(text, source, read_file, functions);
  };
  return text_.empty() ? catalogue : catalogue.with_robot(text_, source_, folder_);
}

py::dict Robot::about() const {
  using namespace py::literals;
  const robot_file::Robot robot = robot_file::read(text_, source_, experiment::files_in(folder_), functions_);
  py::list states, actions, dynamics;
  for (const robot_file::State& state : robot.states)
    states.append(py::dict("name"_a = state.variable.name, "angle"_a = state.variable.kind == StateKind::angle,
                           "start"_a = state.start, "start_noise"_a = state.start_noise));
  for (const ActionVariable& action : robot.actions)
    actions.append(
        py::dict("name"_a = action.name, "bounds"_a = py::make_tuple(action.bounds.low, action.bounds.high)));
  for (const robot_file::Dynamics& each : robot.dynamics) dynamics.append(each.name);
  return py::dict("name"_a = robot.name, "dt_s"_a = robot.dt_s, "horizon"_a = robot.horizon,
                  "has_plant"_a = robot.has_plant, "states"_a = states, "actions"_a = actions, "dynamics"_a = dynamics);
}

void add_robot(py::module_& module) {
  py::class_<Robot, std::shared_ptr<Robot>>(module, "Robot")
      .def(py::init<std::string, std::string, std::string>(), py::arg("text"), py::arg("source"), py::arg("folder"))
      .def("add_step_function", &Robot::add_step_function)
      .def("add_step_condition", &Robot::add_step_condition)
      .def("add_state_function", &Robot::add_state_function)
      .def("add_episode_function", &Robot::add_episode_function)
      .def("add_dynamics", &Robot::add_dynamics)
      .def("add_plant", &Robot::add_plant)
      .def("check", &Robot::check)
      .def("about", &Robot::about);
  module.def(
      "folder_of_files", [](const std::string& file) { return experiment::folder_of_files(file).string(); },
      py::arg("robot_file"));
}

}  // namespace rehearse::python
