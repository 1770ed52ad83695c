#include "python/bindings/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::python {

void set_options(const Fields& fields, const OptionTexts& texts, const std::vector<std::string>& others) {
  Violations violations;
  for (const auto& [name, text] : texts) {
    try {
      if (set_field(fields, name, text)) continue;
      std::vector<std::string> known = others;
      for (const auto& [each, value] : list_fields(fields)) known.push_back(each);
      violations.add(fmt::format("unknown option '{}'{}", name, suggestions(name, known)));
    } catch (const InvalidInput& error) {
      violations.add(error.what());
    }
  }
  violations.throw_if_any();
}

}  // namespace rehearse::python
