#include "rehearse/experiment/spec.hpp"

#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "rehearse/core/names.hpp"

namespace rehearse::experiment {

std::string start_text(const Vector& theta) {
  std::string text;
  for (const double number : theta) text += (text.empty() ? "" : " ") + to_text(number);
  return text;
}

std::optional<Vector> start_of(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream words(text);
  for (std::string word; words >> word;)
    if (!from_text(word, numbers.emplace_back()) || !std::isfinite(numbers.back())) return std::nullopt;
  if (numbers.empty()) return std::nullopt;
  return Vector::Map(numbers.data(), static_cast<Index>(numbers.size()));
}

std::vector<std::string> options_of_runs() {
  Spec spec;
  std::vector<std::string> names;
  for (const auto& [name, text] : list_fields([&](FieldVisitor& v) { spec.settable_fields(v); })) names.push_back(name);
  return names;
}

std::string run_name(const Spec& spec, const std::string& variant) {
  std::string name = fmt::format("{}-{}-{}-", spec.scenario, spec.learner, spec.prior.empty() ? "none" : spec.prior);
  if (!variant.empty()) name += variant + "-";
  return folder_name_of(name + fmt::to_string(spec.seed));
}

std::string default_folder(const Spec& spec) { return "runs/" + run_name(spec); }

Spec with_options(Spec spec, const std::vector<FileOption>& options) {
  for (const FileOption& option : options) spec.options.emplace_back(option.key, option.text);
  return spec;
}

}  // namespace rehearse::experiment
