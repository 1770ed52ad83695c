// The module rehearse._core. python/rehearse has what users see.

#include <cerrno>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "python/bindings/campaign.hpp"
#include "python/bindings/catalogue.hpp"
#include "python/bindings/check.hpp"
#include "python/bindings/evaluation.hpp"
#include "python/bindings/identify.hpp"
#include "python/bindings/interruption.hpp"
#include "python/bindings/outputs.hpp"
#include "python/bindings/pieces.hpp"
#include "python/bindings/policy.hpp"
#include "python/bindings/robot.hpp"
#include "python/bindings/runs.hpp"
#include "rehearse/cli/cli.hpp"
#include "rehearse/core/errors.hpp"
#include "rehearse/core/events.hpp"
#include "rehearse/experiment/run_options.hpp"

namespace rehearse::python {
namespace {

/// The command line. share: the folder of the page of reports.
int command_line(std::vector<std::string> arguments, const std::string& share) {
  std::vector<char*> argv;
  ::program_invocation_short_name = const_cast<char*>("rehearse");  // messages name it (apps/cli/program.hpp)
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const Unlocked unlocked;
  return cli(static_cast<int>(arguments.size()), argv.data(), {}, {}, share.c_str());
}

}  // namespace
}  // namespace rehearse::python

PYBIND11_MODULE(_core, module) {
  using namespace rehearse;
  namespace py = pybind11;
  py::register_exception<InvalidInput>(module, "InvalidInput", PyExc_ValueError);
  py::register_exception<experiment::RunFailed>(module, "RunFailed", PyExc_RuntimeError);
  const auto present = [&](const char* name, const char* text) {
    module.attr(name).attr("__module__") = "rehearse";  // where users find it
    module.attr(name).attr("__doc__") = text;
  };
  present("InvalidInput", "What was given cannot be used: a line for everything that is wrong, with its bound.");
  present("RunFailed", "The plant or the learner failed. What was done is kept, and `resume` goes on.");
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Interrupted&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    }
  });
  module.attr("__version__") = REHEARSE_VERSION;
  python::stop_work_at_exit();
  python::add_robot(module);
  python::add_policy(module);
  python::add_runs(module);
  python::add_evaluation(module);
  python::add_campaign(module);
  python::add_catalogue(module);
  python::add_check(module);
  python::add_outputs(module);
  python::add_identify(module);
  python::add_gp(module);
  python::add_search(module);
  module.def("command_line", &python::command_line, py::arg("arguments"), py::arg("share"));
}
