#include "rehearse/campaign/overlaps.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "rehearse/experiment/priors.hpp"

namespace rehearse::campaign {
namespace {

/// An option of the file, and which part of it gives it.
struct Given {
  std::string part, key;
  Index line = 0;
};

std::vector<Given> given(const std::string& part, const std::vector<experiment::FileOption>& options) {
  std::vector<Given> all;
  for (const experiment::FileOption& option : options) all.push_back({part, option.key, option.line});
  return all;
}

void append(std::vector<Given>& all, const std::vector<Given>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

class Overlaps {
 public:
  explicit Overlaps(const experiment::Spec& complete) : complete_(complete) {}

  /// Notes what both say, unless it is one entry.
  void check(const std::vector<Given>& these, const std::vector<Given>& those) {
    for (const Given& a : these)
      for (const Given& b : those)
        if ((a.line != b.line || a.key != b.key) && reach_the_same(a.key, b.key)) note(a, b);
  }

  std::vector<std::pair<Index, std::string>> found;

 private:
  bool reach_the_same(const std::string& a, const std::string& b) const {
    const auto first = reached_options(complete_, a), second = reached_options(complete_, b);
    return std::any_of(first.begin(), first.end(), [&](const std::string& name) {
      return std::find(second.begin(), second.end(), name) != second.end();
    });
  }

  void note(const Given& a, const Given& b) {
    const auto& [first, second] = a.line <= b.line ? std::pair(a, b) : std::pair(b, a);
    found.emplace_back(second.line, fmt::format("{} of {} is in {} too, line {}{}: only one of them would count",
                                                second.key, second.part, first.part, first.line,
                                                first.key == second.key ? "" : fmt::format(" as {}", first.key)));
  }

  const experiment::Spec& complete_;
};

}  // namespace

std::vector<std::string> reached_options(const experiment::Spec& complete, const std::string& key) {
  const bool several = complete.prior.find(',') != std::string::npos;
  const std::string wanted = several ? key : experiment::without_prior(key, complete.prior);
  const auto is_reached = [&](const std::string& name) {
    if (name == wanted || name == "scenario." + key || name == "learner." + key) return true;
    if (!several || !name.starts_with("prior.") || !key.starts_with("prior.")) return false;
    return name.ends_with(key.substr(key.find('.')));  // prior.NAME of any of several
  };
  std::vector<std::string> reached;
  for (const auto& [name, text] : complete.options)
    if (is_reached(name)) reached.push_back(name);
  for (const std::string& name : experiment::options_of_runs())
    if (name == key) reached.push_back(name);
  return reached;
}

std::vector<std::pair<Index, std::string>> overlaps(const experiment::Spec& complete, const CampaignFile& file) {
  std::vector<Given> draws, axes, fixed = given("[set]", file.options);
  for (const Draw& draw : file.draws) draws.push_back({"[draw]", draw.key, draw.line});
  for (const Axis& axis : file.axes) axes.push_back({"[vary]", axis.key, axis.line});
  const auto own = file.learner_options.find(complete.learner);
  if (own != file.learner_options.end())
    append(fixed, given(fmt::format("[learner.{}]", complete.learner), own->second));
  Overlaps overlaps(complete);
  for (const Variant& variant : file.variants) {
    const auto options = given("[[variant]]", variant.options);
    overlaps.check(options, options);
    overlaps.check(options, axes);
    overlaps.check(options, draws);
  }
  overlaps.check(axes, axes);
  overlaps.check(draws, axes);
  overlaps.check(draws, draws);
  overlaps.check(draws, fixed);
  return overlaps.found;
}

}  // namespace rehearse::campaign
