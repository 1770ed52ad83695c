#include "python/bindings/outputs.hpp"

#include <filesystem>
#include <string>

#include "apps/catalogue.hpp"
#include "apps/cli/output_file.hpp"
#include "apps/cli/report_page.hpp"

namespace rehearse::python {

namespace py = pybind11;

constexpr const char* kPageArgument = "out=\"FILE.html\"";  // as messages name it

void add_outputs(py::module_& module) {
  using namespace py::literals;
  module.def(
      "report",
      [](const std::string& folder, const std::string& share) {
        return apps::report_page(apps::to_look(apps::catalogue()), folder, share).html;
      },
      "folder"_a, "share"_a);
  module.def(
      "replay",
      [](const std::string& folder, Index trial, const std::string& headline, const std::string& share) {
        return apps::replay_page(folder, trial, share, headline).html;
      },
      "folder"_a, "trial"_a, "headline"_a, "share"_a);
  module.def(
      "check_page",
      [](const std::string& path, const std::string& share) {
        apps::check_output(apps::page_file(path, kPageArgument));
        apps::require_page_template(share);
      },
      "path"_a, "share"_a);
  module.def(
      "write_page",
      [](const std::string& path, const std::string& text) {
        apps::write_output(apps::page_file(path, kPageArgument), text);
      },
      "path"_a, "text"_a);
  module.def(
      "write_policy",
      [](const std::string& path, const std::string& text) {
        apps::write_output(
            apps::policy_file(path, "export(\"FILE" + std::filesystem::path(path).extension().string() + "\")"), text);
      },
      "path"_a, "text"_a);
}

}  // namespace rehearse::python
