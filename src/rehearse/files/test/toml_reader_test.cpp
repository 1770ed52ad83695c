#include "rehearse/files/toml_reader.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rehearse/core/test/test_tools.hpp"

namespace rehearse::files {
namespace {

std::string complaint(const FileViolations& violations) {
  return message_of<InvalidInput>([&] { violations.throw_if_any(); });
}

TEST(FileViolations, AreInTheOrderOfTheLinesAndSaidOnce) {
  FileViolations violations("x.toml");
  EXPECT_EQ(complaint(violations), "");
  violations.add(12, "late");
  violations.add(3, "early");
  violations.add(12, "late");
  violations.add(0, "of no line");
  EXPECT_EQ(complaint(violations), "x.toml: of no line\nx.toml: line 3: early\nx.toml: line 12: late");
}

TEST(TomlReader, TakesWhatIsRightAndSaysEverythingElse) {
  const toml::table table = parse_toml(R"(name = "a"
text = 3
names = ["b", "c", "b"]
steps = 2.5
count = -1
table = 1
nmae = "d"
)",
                                       "x.toml");
  FileViolations violations("x.toml");
  TomlReader reader(table, "[run]", violations);
  std::string name = "before", text = "before", missing = "before";
  std::vector<std::string> names;
  double steps = 0;
  Index count = 7;
  EXPECT_TRUE(reader.take("name", name));
  EXPECT_TRUE(reader.take("text", text));
  EXPECT_FALSE(reader.take("missing", missing));
  EXPECT_TRUE(reader.take("names", names));
  reader.take_fields([&](FieldVisitor& v) {
    v.number("steps", steps, "a number");
    v.integer("count", count, "a count", at_least(0));
  });
  EXPECT_FALSE(reader.take_table("table"));
  EXPECT_FALSE(reader.take_table("missing")) << "asked for twice, it is listed once";
  reader.finish();
  EXPECT_EQ(name + " " + text + " " + missing, "a before before");
  EXPECT_EQ(steps, 2.5);
  EXPECT_EQ(complaint(violations),
            "x.toml: line 2: text must be text in quotes\n"
            "x.toml: line 3: names names 'b' twice\n"
            "x.toml: line 5: count = -1, must be ≥ 0\n"
            "x.toml: line 6: table must be a table\n"
            "x.toml: line 7: unknown key 'nmae' in [run], did you mean 'name'? (known: name, text, missing, names, "
            "steps, count, table)");
}

TEST(Toml, RefusesKeysThatAreTooDeep) {
  std::string deep = "a";
  for (int i = 0; i < 50000; ++i) deep += i % 2 ? ".a" : " . \"=\"";
  const std::string numbers = "x = [" + std::string(1000, ' ') + "0.1, 0.2] # " + std::string(1000, '.') + "\n";
  EXPECT_EQ(message_of<InvalidInput>([&] { parse_toml(numbers + deep + " = 1\n", "x.toml"); }),
            "x.toml: line 2: a key has more than 256 parts");
  EXPECT_EQ(message_of<InvalidInput>([&] { parse_toml("[" + deep + "]\n", "x.toml"); }),
            "x.toml: line 1: a key has more than 256 parts");
  EXPECT_EQ(parse_toml(numbers, "x.toml").size(), 1U);
  for (const char* text :
       {R"("\\")", R"("""#""")", R"("""a"""")", R"('''"''')"})  // none of them hides the key behind it
    EXPECT_EQ(message_of<InvalidInput>([&] { parse_toml(fmt::format("k = {{p = {}, {} = 1}}\n", text, deep), ""); }),
              "line 1: a key has more than 256 parts")
        << text;
  const std::string dots(1000, '.');
  for (const char* text : {"'''\n{}'''", R"("\"{}")", R"("""\"{}"""")", "'{}'"})  // a text is no key
    EXPECT_EQ(parse_toml(fmt::format("x = {}\ny = 1\n", fmt::format(fmt::runtime(text), dots)), "x.toml").size(), 2U);
}

TEST(TomlReader, NumbersAndFlagsStandWithoutQuotes) {
  const toml::table table = parse_toml("a = \"1\"\nb = \"2\"\nc = \"true\"\nd = \"text\"\ne = \"y\"\n", "x.toml");
  FileViolations violations("x.toml");
  TomlReader reader(table, "", violations);
  double a = 0;
  Index b = 0;
  bool c = false;
  std::string d;
  enum class E { x, y } e = E::x;
  reader.take_fields([&](FieldVisitor& v) {
    v.number("a", a, "");
    v.integer("b", b, "");
    v.boolean("c", c, "");
    v.text("d", d, "");
    v.choice("e", e, "", {"x", "y"});
  });
  EXPECT_EQ(complaint(violations),
            "x.toml: line 1: a = \"1\", must be a number, without quotes\n"
            "x.toml: line 2: b = \"2\", must be a whole number, without quotes\n"
            "x.toml: line 3: c = \"true\", must be true or false, without quotes");
  EXPECT_EQ(d, "text");
  EXPECT_EQ(e, E::y);
}

TEST(TomlReader, SaysWhichFieldIsAListOrATable) {
  const toml::table table = parse_toml("width = [1, 2]\nname = [\"a\"]\nsteps = { few = 3 }\n", "x.toml");
  FileViolations violations("x.toml");
  TomlReader reader(table, "", violations);
  double width = 0;
  std::string name;
  Index steps = 0;
  reader.take_fields([&](FieldVisitor& v) {
    v.number("width", width, "");
    v.text("name", name, "");
    v.integer("steps", steps, "");
  });
  EXPECT_EQ(complaint(violations),
            "x.toml: line 1: width must be a number, not a list\n"
            "x.toml: line 2: name must be text in quotes, not a list\n"
            "x.toml: line 3: steps must be a whole number, not a table");
}

TEST(Toml, SaysWhatToDoAboutTheParsersErrors) {
  const auto ends_with = [](const std::string& text, const std::string& remedy) {
    return message_of<InvalidInput>([&] { parse_toml("a = 1\n" + text, "x.toml"); }).ends_with(remedy);
  };
  for (const char* value : {"m * l", "Nm", "foo", "true_ish", "2 * a", "2*a", "0.5*m", "10m", "5 kg", "(a + b)"})
    EXPECT_TRUE(ends_with(fmt::format("z = {}\n", value), "; formulas, names and units stand in quotes")) << value;
  EXPECT_TRUE(ends_with("[state]\nb = 1\n[state]\nb = 2\n", "each is in double brackets, such as [[state]]"));
  EXPECT_FALSE(ends_with("z = [1, 2\n", "in quotes"));
}

TEST(TomlReader, WordsOfACommandMayRepeat) {
  const toml::table table = parse_toml("program = [\"p\", \"1\", \"1\"]\n", "x.toml");
  FileViolations violations("x.toml");
  TomlReader reader(table, "", violations);
  std::vector<std::string> words;
  EXPECT_TRUE(reader.take_words("program", words));
  EXPECT_EQ(words, (std::vector<std::string>{"p", "1", "1"}));
  EXPECT_TRUE(violations.empty());
}

TEST(Toml, LeavesKeepTheOrderOfTheFile) {
  const toml::table table = parse_toml("z = 1\na.c = true\n[b]\ny = \"t\"\nx = [1]\n", "x.toml");
  std::string all;
  for (const auto& [key, node] : leaves(table, "p")) all += key + (node->is_array() ? "" : "=" + text_of(*node)) + " ";
  EXPECT_EQ(all, "p.z=1 p.a.c=true p.b.y=t p.b.x ");
  EXPECT_EQ(line_of(*leaves(table).back().second), 5);
  EXPECT_THROW(text_of(*leaves(table).back().second), InvalidInput);
  FileViolations violations("x.toml");
  EXPECT_EQ(text_of("key", *leaves(table).back().second, violations), std::nullopt);
  EXPECT_EQ(message_of<InvalidInput>([&] { violations.throw_if_any(); }),
            "x.toml: line 5: key: a value must be a number, true, false or text");
  EXPECT_TRUE(
      message_of<InvalidInput>([] { parse_toml("a = 1\nb = = 2\n", "x.toml"); }).starts_with("x.toml: line 2: "));
}

}  // namespace
}  // namespace rehearse::files
