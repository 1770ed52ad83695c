#include "rehearse/experiment/memory.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/experiment/resolve.hpp"

namespace rehearse::experiment {
namespace {

constexpr std::size_t kMost = 3;
constexpr double kUsualSteps = 100;  // of an episode

/// How a size counts: each unit of it for so many things, of which so many are usual where the default is less.
struct Unit {
  double things = 1, usual = 1;
};

/// The options that memory may grow with: numbers of things, and times, in control steps.
class SizeCollector final : public FieldVisitor {
 public:
  explicit SizeCollector(double dt_s) : step_{1 / dt_s, kUsualSteps} {}

  template <class Builder>
  void collect(const std::string& section, Builder& builder) {
    section_ = section;
    builder.fields(*this);
  }
  const std::map<std::string, Unit>& units() const { return units_; }

 private:
  void visit(const std::string& name, double& /*value*/, Bound /*bound*/) override {
    if (help().text.find("[s]") != std::string_view::npos) units_[section_ + name] = step_;
  }
  void visit(const std::string& name, Index& /*value*/, Bound /*bound*/) override { units_[section_ + name] = {}; }
  void visit(const std::string& /*name*/, bool& /*value*/) override {}
  void visit(const std::string& /*name*/, std::string& /*value*/) override {}
  void visit(const std::string& /*name*/, int& /*value*/, const std::vector<std::string>& /*names*/) override {}

  Unit step_;
  std::string section_;
  std::map<std::string, Unit> units_;
};

struct Size {
  std::string text;
  double times_usual = 0;
};

double number_of(const std::string& text) {
  double value = 0;
  return from_text(text, value) ? value : 0;
}

std::vector<Size> sizes_of_options(const Catalogue& catalogue, const Spec& spec, double dt_s) {
  SizeCollector collector(dt_s);
  collector.collect("scenario.", *catalogue.scenario(spec.scenario));
  collector.collect("learner.", *catalogue.learner(spec.learner));
  const Spec bare = completed(catalogue, {.scenario = spec.scenario, .learner = spec.learner, .prior = spec.prior});
  const std::map<std::string, std::string> defaults(bare.options.begin(), bare.options.end());
  std::vector<Size> sizes;
  for (const auto& [key, text] : spec.options) {
    const auto unit = collector.units().find(key);
    const auto normal = defaults.find(key);
    if (unit == collector.units().end() || normal == defaults.end()) continue;
    const auto [things, usual] = unit->second;
    sizes.push_back({fmt::format("{} = {}", key, text),
                     number_of(text) * things / std::max(usual, number_of(normal->second) * things)});
  }
  return sizes;
}

}  // namespace

std::string not_enough_memory(const Catalogue& catalogue, const Spec& complete) {
  const Task task = resolve_begun(catalogue, complete).scenario.task;
  std::vector<Size> sizes = sizes_of_options(catalogue, complete, task.dt_s);
  if (const RobotFile* robot = catalogue.robot(complete.scenario))
    sizes.push_back({fmt::format("horizon = {} of {}", task.horizon, robot->source),
                     static_cast<double>(task.horizon) / kUsualSteps});
  std::erase_if(sizes, [](const Size& size) { return !(size.times_usual > 1); });
  if (sizes.empty()) return "there is not enough memory, and no size that is asked for is larger than usual";
  std::ranges::stable_sort(sizes, std::ranges::greater(), &Size::times_usual);
  std::vector<std::string> named;
  for (const Size& size : sizes)
    if (named.size() < kMost) named.push_back(size.text);
  return fmt::format("there is not enough memory; the largest sizes that are asked for: {}", fmt::join(named, ", "));
}

}  // namespace rehearse::experiment
