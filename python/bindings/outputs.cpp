#include "python/bindings/outputs.hpp"

#include <string>

#include "apps/catalogue.hpp"
#include "apps/cli/output_file.hpp"
#include "apps/cli/report_page.hpp"

namespace rehearse::python {

namespace py = pybind11;

void add_outputs(py::module_& module) {
  using namespace py::literals;
  module.def(
      "report",
      [](const std::string& folder, const std::string& share) {
        return apps::report_page(apps::to_look(apps::catalogue()), folder, share).html;
      },
      "folder"_a, "share"_a);
  module.def(
      "write_page",
      [](const std::string& path, const std::string& text) {
        apps::write_output(apps::page_file(path, "report(\"FILE.html\")"), text);
      },
      "path"_a, "text"_a);
  module.def(
      "write_policy",
      [](const std::string& path, const std::string& text) {
        apps::write_output(apps::policy_file(path, "export(\"FILE.h\")"), text);
      },
      "path"_a, "text"_a);
}

}  // namespace rehearse::python
