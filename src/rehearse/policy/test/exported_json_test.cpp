#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "exported_fixture.hpp"

namespace rehearse::policy {
namespace {

using exports::Case;

std::vector<double> with_one(std::vector<double> values) {
  values.push_back(1);
  return values;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a.at(i) * b.at(i);
  return sum;
}

std::vector<double> features(const nlohmann::json& computes, const std::vector<double>& state) {
  std::vector<double> inputs;
  for (const auto& input : computes.at("inputs")) {
    const double x = state.at(input.at("state").get<std::size_t>());
    const std::string function = input.at("function");
    inputs.push_back((function == "cos"   ? std::cos(x)
                      : function == "sin" ? std::sin(x)
                                          : x) /
                     input.at("scale").get<double>());
  }
  return inputs;
}

double squared_distance(const std::vector<double>& x, const std::vector<double>& centre,
                        const std::vector<double>& lengths) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += std::pow((x[i] - centre.at(i)) / lengths.at(i), 2);
  return sum;
}

/// Differences from a state, angles the shorter way round.
std::vector<double> from(const std::vector<double>& other, const nlohmann::json& angles,
                         const std::vector<double>& state) {
  const double turn = 2 * std::numbers::pi;
  std::vector<double> apart = state;
  for (std::size_t i = 0; i < state.size(); ++i) {
    apart[i] -= other.at(i);
    if (angles.at(i)) apart[i] -= turn * std::floor(apart[i] / turn + 0.5);
  }
  return apart;
}

/// The action of a row of linear feedback, without the bounds.
double feedback_of(const nlohmann::json& computes, std::size_t row, std::size_t action,
                   const std::vector<double>& state) {
  const std::vector<double> apart = from(computes.at("states").at(row), computes.at("angles"), state);
  double u = computes.at("actions").at(row).at(action);
  for (std::size_t i = 0; i < state.size(); ++i)
    u += computes.at("gains").at(row).at(action * state.size() + i).get<double>() * apart[i];
  return u;
}

/// The action near the goal, without the bounds; empty elsewhere.
std::optional<double> action_near(const nlohmann::json& near, std::size_t action, const std::vector<double>& state) {
  const std::vector<double> apart = from(near.at("state"), near.at("angles"), state);
  double inside = 0;
  for (std::size_t i = 0; i < apart.size(); ++i) inside += apart[i] * dot(near.at("shape").at(i), apart);
  if (inside >= 1) return std::nullopt;
  return near.at("action").at(action).get<double>() + dot(near.at("gain").at(action), apart);
}

/// The action by the description in docs/export.md alone.
double action_of(const nlohmann::json& policy, std::size_t action, const std::vector<double>& state, double t_s) {
  const auto& computes = policy.at("computes");
  const double low = policy.at("actions").at(action).at("low"), high = policy.at("actions").at(action).at("high");
  if (const auto near = computes.contains("near") ? action_near(computes.at("near"), action, state) : std::nullopt)
    return std::clamp(*near, low, high);
  const auto row_of = [&](const char* name) { return computes.at(name).at(action).get<std::vector<double>>(); };
  if (computes.at("form") == "table") {
    const std::size_t rows = computes.at("actions").size();
    const auto row = static_cast<std::size_t>(std::round(t_s * computes.at("per_s").get<double>()));
    const std::size_t place = computes.at("periodic") ? row % rows : std::min(row, rows - 1);
    return computes.at("actions").at(place).at(action);
  }
  if (computes.at("form") == "feedback") {
    const std::size_t last = computes.at("actions").size() - 1;
    const double place = std::min(t_s * computes.at("per_s").get<double>(), static_cast<double>(last));
    const auto row = static_cast<std::size_t>(place);
    const double u = feedback_of(computes, row, action, state),
                 next = feedback_of(computes, std::min(row + 1, last), action, state);
    return std::clamp(u + (place - static_cast<double>(row)) * (next - u), low, high);
  }
  std::vector<double> v = features(computes, state);
  double a = 0;
  if (computes.at("form") == "layers") {
    std::vector<double> units;
    for (const auto& unit : computes.at("hidden")) units.push_back(std::tanh(dot(unit, with_one(v))));
    a = dot(row_of("output"), with_one(units.empty() ? v : units));
  } else {
    const std::vector<double> weights = row_of("weights");
    for (std::size_t c = 0; c < weights.size(); ++c)
      a += weights[c] * std::exp(-0.5 * squared_distance(v, computes.at("centres").at(c), row_of("lengths")));
  }
  a *= computes.at("gain").get<double>();
  const double squashed = computes.at("squash") == "tanh" ? std::tanh(a) : (9 * std::sin(a) + std::sin(3 * a)) / 8;
  return std::clamp((low + high) / 2 + (high - low) / 2 * squashed, low, high);
}

TEST(ExportedJson, IsThePolicy) {
  for (const Case& each : exports::cases()) {
    const Exported exported = exports::exported(each, exports::asked(200, each.task.dt_s));
    const auto json = nlohmann::json::parse(to_json(exported));
    const auto& test = json.at("test");
    ASSERT_EQ(test.at("states").size(), 200u);
    for (std::size_t i = 0; i < 200; ++i)
      for (std::size_t a = 0; a < each.task.actions.size(); ++a)
        EXPECT_NEAR(action_of(json, a, test.at("states").at(i), test.at("times_s").at(i)),
                    test.at("actions").at(i).at(a).get<double>(), 1e-11)
            << each.name;
  }
}

TEST(ExportedJson, SaysWhereItComesFrom) {
  const Case of = exports::cases().front();
  const auto json = nlohmann::json::parse(to_json(exports::exported(of, exports::asked(1, 0.1))));
  EXPECT_EQ(json.at("format"), 1);
  EXPECT_EQ(json.at("robot"), "slider");
  EXPECT_EQ(json.at("prior"), "near");
  EXPECT_EQ(json.at("trial"), 2);
  EXPECT_EQ(json.at("return"), 4.5);
  EXPECT_EQ(json.at("policy"), "linear");
  EXPECT_EQ(json.at("states").at(1).at("name"), "angle");
  EXPECT_EQ(json.at("theta").get<std::vector<double>>(), std::vector<double>(of.theta.begin(), of.theta.end()));
}

}  // namespace
}  // namespace rehearse::policy
