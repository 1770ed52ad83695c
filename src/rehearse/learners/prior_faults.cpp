#include "rehearse/learners/prior_faults.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rehearse::learners {
namespace {

template <class Variable>
std::string named(const std::vector<Variable>& variables, const Vector& values) {
  constexpr Index kMost = 6;
  std::vector<std::string> texts;
  for (Index i = 0; i < std::min(values.size(), static_cast<Index>(variables.size())); ++i)
    texts.push_back(i < kMost ? fmt::format("{} = {:.4g}", variables[static_cast<std::size_t>(i)].name, values(i))
                              : "…");
  if (texts.size() > kMost) texts.resize(kMost + 1);
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace

Setting watched(Setting setting) {
  if (setting.prior) setting.prior->fault = std::make_shared<system::FirstFault>();
  return setting;
}

void forget_faults(const Setting& setting) {
  if (setting.prior && setting.prior->fault) setting.prior->fault->clear();
}

std::string fault_of_prior(const Setting& setting) {
  if (!setting.prior || !setting.prior->fault) return {};
  const auto fault = setting.prior->fault->get();
  if (!fault) return {};
  return fmt::format("in {} under {}: {}", named(setting.task.states, fault->x), named(setting.task.actions, fault->u),
                     fault->why.empty() ? "it gives no finite change" : fault->why);
}

}  // namespace rehearse::learners
