// The schema of robots' files, for editors, has the keys that are read.
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rehearse/core/errors.hpp"
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
  const std::regex complaint(R"(unknown key 'zzz'(?: in (\S+))?, did you mean .*\(known: (.*)\))"), comma(", ");
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

}  // namespace
}  // namespace rehearse::robot_file
