#include "rehearse/experiment/memory.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rehearse/experiment/resolve.hpp"

namespace rehearse::experiment {
namespace {

constexpr std::size_t kMost = 3;

struct Size {
  std::string name;
  Index value = 0;
};

std::optional<Index> whole_number(const std::string& text) {
  Index value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

template <class Counts>
std::vector<Size> sizes_of(const Spec& spec, Counts counts) {
  std::vector<Size> sizes;
  for (const auto& option : spec.options)
    if (const auto value = whole_number(option.second); value && counts(option))
      sizes.push_back({option.first, *value});
  std::stable_sort(sizes.begin(), sizes.end(), [](const Size& a, const Size& b) { return a.value > b.value; });
  sizes.resize(std::min(sizes.size(), kMost));
  return sizes;
}

std::set<std::pair<std::string, std::string>> defaults_of(const Catalogue& catalogue, const Spec& spec) {
  const Spec bare = completed(catalogue, {.scenario = spec.scenario, .learner = spec.learner, .prior = spec.prior});
  return {bare.options.begin(), bare.options.end()};
}

}  // namespace

std::string not_enough_memory(const Catalogue& catalogue, const Spec& complete) {
  const auto defaults = defaults_of(catalogue, complete);
  std::vector<Size> sizes = sizes_of(complete, [&](const auto& option) { return !defaults.contains(option); });
  if (sizes.empty()) sizes = sizes_of(complete, [](const auto&) { return true; });
  std::vector<std::string> named;
  for (const auto& [name, value] : sizes) named.push_back(fmt::format("{} = {}", name, value));
  return fmt::format("there is not enough memory; the largest sizes that are asked for: {}", fmt::join(named, ", "));
}

}  // namespace rehearse::experiment
