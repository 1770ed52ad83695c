#include "rehearse/campaign/seeds.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/experiment/spec.hpp"
#include "rehearse/files/toml_reader.hpp"

namespace rehearse::campaign {
namespace {

constexpr Index kMostSeeds = 100000;

/// Adds the seeds of "3" or "1-30". Throws InvalidInput.
void add_seeds(const std::string& text, std::vector<Index>& seeds) {
  const auto number = [&](std::string_view digits) {
    Index value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || value < 0 ||
        static_cast<double>(value) > experiment::kMostSeed)
      throw InvalidInput(fmt::format("seeds = {}, must be whole numbers from 0 to 2^53, or \"FIRST-LAST\"", text));
    return value;
  };
  const std::size_t dash = text.find('-');
  const Index first = number(std::string_view(text).substr(0, dash));
  const Index last = dash == std::string::npos ? first : number(std::string_view(text).substr(dash + 1));
  if (last < first) throw InvalidInput(fmt::format("seeds = \"{}\", the first must not be above the last", text));
  if (last - first >= kMostSeeds)
    throw InvalidInput(fmt::format("seeds = \"{}\" are {}, must be ≤ {}", text, last - first + 1, kMostSeeds));
  for (Index seed = first; seed <= last; ++seed) seeds.push_back(seed);
}

}  // namespace

std::vector<Index> seeds_of(const toml::node& node) {
  std::vector<Index> seeds;
  const auto add = [&](const toml::node& element) {
    if (!element.is_integer() && !element.is_string())
      throw InvalidInput("seeds must be whole numbers, \"FIRST-LAST\", or a list of these");
    add_seeds(files::text_of(element), seeds);
  };
  if (const auto* list = node.as_array())
    for (const toml::node& element : *list) add(element);
  else
    add(node);
  if (seeds.empty()) throw InvalidInput("seeds has none");
  std::vector<Index> sorted = seeds;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) throw InvalidInput(fmt::format("seeds has {} twice", *twice));
  return seeds;
}

}  // namespace rehearse::campaign
