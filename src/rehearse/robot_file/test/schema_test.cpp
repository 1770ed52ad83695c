// The schema of robots' files, for editors, has the keys that are read.
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <tuple>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"
#include "rehearse/robot_file/robot.hpp"
#include "rehearse/robot_file/test/example.hpp"

namespace rehearse::robot_file {
namespace {

using Json = nlohmann::json;

Json schema() {
  const std::filesystem::path path(TEST_DATA_DIR "/../../../../../schemas/robot.json");
  std::ifstream file(path.lexically_normal());
  return Json::parse(file);
}

/// The example with an unknown key in every part.
std::string with_unknown_keys() {
  std::string text = "zzz = 1\n" + example::kSwing;
  for (const char* part : {"[[state]]", "[[action]]", "[reward]", "[success]", "[dynamics.pendulum]", "[plant]"}) {
    const std::size_t at = text.find(part);
    text.insert(text.find('\n', at) + 1, "zzz = 1\n");
  }
  return text + R"toml(
[prior.other]
zzz = 1
[policy]
zzz = 1
[[limit]]
keep = "u < 3"
zzz = 1
[[body]]
name = "b"
from = [0, 0]
to = [1, 1]
zzz = 1
[dynamics.program]
program = ["cat"]
zzz = 1
[dynamics.model]
model = "m.xml"
zzz = 1
[dynamics.model.parameters]
p = { value = 1, sets = { what = "body b mass", zzz = 1 }, zzz = 1 }
[dynamics.model.state]
rate = { velocity = "j", zzz = 1 }
)toml";
}

using Keys = std::map<std::string, std::set<std::string>>;  // of parts

/// The keys that are read, as the complaints say them.
Keys known_keys() {
  const std::regex complaint(R"(unknown key 'zzz'(?: in (\S+?))?(?:, did you mean '[^']*'\?)? \(known: (.*)\))"),
      comma(", ");
  Keys known;
  const auto folder = [](const std::string&) { return std::optional<std::string>("bytes"); };
  try {
    builder(with_unknown_keys(), "swing.toml", folder);
  } catch (const InvalidInput& error) {
    for (const std::string& line : error.violations()) {
      std::smatch match;
      if (!std::regex_search(line, match, complaint)) continue;
      const std::string keys = match[2];
      known[match[1]].insert(std::sregex_token_iterator(keys.begin(), keys.end(), comma, -1),
                             std::sregex_token_iterator());
    }
  }
  return known;
}

std::set<std::string> properties(const Json& table) {
  std::set<std::string> keys;
  for (const auto& [key, value] : table.at("properties").items()) keys.insert(key);
  return keys;
}

TEST(Schema, HasTheKeysThatAreRead) {
  const Json schema = robot_file::schema();
  const Json& parts = schema.at("properties");
  const Keys known = known_keys();
  ASSERT_EQ(known.size(), 15u);
  EXPECT_EQ(properties(schema), known.at(""));
  for (const char* list : {"state", "action", "limit", "body"})
    EXPECT_EQ(properties(parts.at(list).at("items")), known.at(std::string("[[") + list + "]]")) << list;
  for (const char* table : {"reward", "success", "plant", "policy"})
    EXPECT_EQ(properties(parts.at(table)), known.at(std::string("[") + table + "]")) << table;
  EXPECT_EQ(properties(parts.at("prior").at("additionalProperties")), known.at("[prior.other]"));

  const Json& dynamics = parts.at("dynamics").at("additionalProperties");
  std::set<std::string> all = known.at("[dynamics.pendulum]");
  all.insert(known.at("[dynamics.program]").begin(), known.at("[dynamics.program]").end());
  all.insert(known.at("[dynamics.model]").begin(), known.at("[dynamics.model]").end());
  EXPECT_EQ(properties(dynamics), all);
  EXPECT_EQ(properties(dynamics.at("properties").at("state").at("additionalProperties").at("anyOf").at(1)),
            known.at("state.rate"));
}

TEST(Schema, RequiresWhatMustBeThere) {
  const std::vector<std::pair<std::string, std::string>> parts = {
      {"format", "format = 1"},
      {"name", "name = \"told\""},
      {"dt_s", "dt_s = 0.1"},
      {"horizon", "horizon = 5"},
      {"state", "[[state]]\nname = \"x\""},
      {"action", "[[action]]\nname = \"u\"\nbounds = [-1, 1]"},
      {"reward", "[reward]\nformula = \"-x^2\""},
  };
  const auto file_without = [&](const std::string& left_out) {
    std::string text;
    for (const auto& [key, part] : parts)
      if (key != left_out) text += part + "\n";
    return text;
  };
  const auto none = [](const std::string&) { return std::optional<std::string>(); };
  EXPECT_NO_THROW(builder(file_without(""), "told.toml", none));
  std::set<std::string> needed;
  for (const auto& [key, part] : parts) {
    EXPECT_THROW(builder(file_without(key), "told.toml", none), InvalidInput) << key;
    needed.insert(key);
  }
  EXPECT_EQ(robot_file::schema().at("required").get<std::set<std::string>>(), needed);
}

TEST(Schema, HasTheDefaults) {
  const Json schema = robot_file::schema();
  const Json& parts = schema.at("properties");
  const auto in = [&](const std::string& part, const std::string& key) {
    const Json& node = parts.at(part);
    const Json& table = node.contains("items") ? node.at("items")
                        : part == "dynamics"   ? node.at("additionalProperties")
                                               : node;
    return table.at("properties").at(key).at("default");
  };
  const Actuation actuation;
  const std::vector<std::tuple<std::string, std::string, Json>> defaults = {
      {"state", "start", State().start},
      {"state", "start_noise", State().start_noise},
      {"state", "scale", State().scale},
      {"state", "angle", State().variable.kind == StateKind::angle},
      {"action", "filter_s", actuation.filter_s},
      {"action", "delay_s", actuation.delay_s},
      {"action", "lag_s", actuation.lag_s},
      {"action", "remember", actuation.remember},
      {"reward", "width", RewardFormulas().width},
      {"reward", "floor", RewardFormulas().floor},
      {"success", "last_s", Success().last_s},
      {"limit", "risk", LimitFormula().risk},
      {"dynamics", "start_s", ProgramSource().start_s},
      {"dynamics", "answer_s", ProgramSource().answer_s},
      {"policy", "hidden", scenario::PolicyOptions().hidden},
      {"policy", "policy_gain", scenario::PolicyOptions().policy_gain},
      {"policy", "centres", scenario::PolicyOptions().centres},
      {"body", "width_m", Body().width_m},
  };
  for (const auto& [part, key, value] : defaults) EXPECT_EQ(in(part, key), value) << part << "." << key;
}

TEST(Schema, DescriptionsBeginWithTheirSubject) {
  Index descriptions = 0;
  const std::function<void(const Json&)> visit = [&](const Json& node) {
    if (node.is_object() && node.contains("description") && node["description"].is_string()) {
      ++descriptions;
      EXPECT_FALSE(node["description"].get<std::string>().starts_with("what ")) << node["description"];
    }
    if (node.is_structured())
      for (const Json& part : node) visit(part);
  };
  visit(schema());
  EXPECT_GT(descriptions, 50);
}

}  // namespace
}  // namespace rehearse::robot_file
