#include "rehearse/learners/prior_faults.hpp"

#include <fmt/format.h>

#include "rehearse/core/row_text.hpp"

namespace rehearse::learners {
namespace {

constexpr Index kMostNamed = 6;  // states, or actions, of a row

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
  return fmt::format("in {} under {}: {}", row_text(setting.task.states, fault->x, kMostNamed),
                     row_text(setting.task.actions, fault->u, kMostNamed),
                     fault->why.empty() ? "it gives no change that can be used" : fault->why);
}

}  // namespace rehearse::learners
