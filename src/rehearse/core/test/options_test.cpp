#include "rehearse/core/options.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "test_tools.hpp"

namespace rehearse {
namespace {

enum class Colour { red, green };

struct Inner {
  Index population = 17;
  void fields(FieldVisitor& v) { v.integer("population", population, "candidates", at_least(4)); }
};
struct Outer {
  double width = 0.5;
  double share = 0.25;
  bool active = true;
  Colour colour = Colour::green;
  Inner cmaes;
  void fields(FieldVisitor& v) {
    v.number("width", width, "of the box [m]", above(0));
    v.number("share", share, expert("of the box"), between(0, 1));
    v.require(!(share > width), "share = " + to_text(share) + ", must be ≤ width = " + to_text(width));
    v.boolean("active", active, "or not");
    v.choice("colour", colour, "of the box", {"red", "green"});
    v.group("cmaes", cmaes, kExpert);
  }
};

Fields fields_of(Outer& options) {
  return [&](FieldVisitor& v) { options.fields(v); };
}

std::string refusal(Outer& options, const char* name, const char* text) {
  return message_of<InvalidInput>([&] { set_field(fields_of(options), name, text); });
}

TEST(Options, AreFiniteUnlessTheirBoundAllowsOther) {
  Outer options;
  EXPECT_EQ(refusal(options, "width", "inf"), "width = inf, must be finite");
  double target = 0;
  const Fields fields = [&](FieldVisitor& v) { v.number("target", target, "to stop at", any_value()); };
  EXPECT_TRUE(set_field(fields, "target", "inf"));
  EXPECT_EQ(field_violations(fields).size(), 0u);
  Index seed = 0;
  const Fields exact = [&](FieldVisitor& v) { v.integer("seed", seed, "of the run", between(0, 9007199254740992.0)); };
  EXPECT_TRUE(set_field(exact, "seed", "9007199254740992"));
  EXPECT_THROW(set_field(exact, "seed", "9007199254740993"), InvalidInput);
  EXPECT_THROW(set_field(exact, "seed", "9223372036854775807"), InvalidInput);
}

TEST(Options, AChoiceThatHasOnAndOffTakesTrueAndFalse) {
  enum class Image { off, on, automatic } image = Image::automatic;
  const Fields fields = [&](FieldVisitor& v) { v.choice("image", image, "is used", {"off", "on", "auto"}); };
  EXPECT_TRUE(set_field(fields, "image", "true"));
  EXPECT_EQ(image, Image::on);
  EXPECT_TRUE(set_field(fields, "image", "false"));
  EXPECT_EQ(image, Image::off);
  Outer options;
  EXPECT_EQ(refusal(options, "colour", "true"), "colour = true, must be one of red, green");
}

TEST(Options, AreListedInTheirOrder) {
  Outer options;
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"width", "0.5"}, {"share", "0.25"}, {"active", "true"}, {"colour", "green"}, {"cmaes.population", "17"}};
  EXPECT_EQ(list_fields(fields_of(options)), expected);
}

struct Kept {
  double width = 0.5;
  Index count = 3;
  bool active = true;
  Colour colour = Colour::green;
  Inner inner, other;
  void fields(FieldVisitor& v) {
    v.number("width", width, "of the box [m]", above(0), published(0.1));
    v.integer("count", count, "of boxes", at_least(1), published(40000000, kAuthors));
    v.boolean("active", active, "or not", published(false));
    v.choice("colour", colour, "of the box", {"red", "green"}, published("red", "a book"));
    v.publish("inner.population", published(10));
    v.group("inner", inner);
    v.group("other", other);
  }
};

TEST(Options, KnowWhatIsPublishedOfThem) {
  Kept options;
  std::string text;
  for (const Field& field : describe_fields([&](FieldVisitor& v) { v.group("kept", options); }))
    if (const auto& [value, source] = field.published; !value.empty())
      text += field.name + " = " + value + " (" + source + ")\n";
  EXPECT_EQ(text,
            "kept.width = 0.1 (the paper)\n"
            "kept.count = 40000000 (the authors' code)\n"
            "kept.active = false (the paper)\n"
            "kept.colour = red (a book)\n"
            "kept.inner.population = 10 (the paper)\n");
}

TEST(Options, AnOwnersWordOnWhatIsPublishedCountsMoreThanTheStructs) {
  struct Outermost {
    Kept kept;
    void fields(FieldVisitor& v) {
      v.publish("kept.width", {});
      v.publish("kept.inner.population", published(12));
      v.group("kept", kept);
    }
  } options;
  const std::vector<Field> list = describe_fields([&](FieldVisitor& v) { options.fields(v); });
  ASSERT_EQ(list.size(), 6u);
  EXPECT_EQ(list[0].published.text, "");
  EXPECT_EQ(list[1].published.text, "40000000");
  EXPECT_EQ(list[4].published.text, "12");
}

std::string description(const Field& field) {
  std::string choices;
  for (const std::string& choice : field.choices) choices += " " + choice;
  return field.name + " | " + field.value + " | " + field.bound + choices + " | " + field.help +
         (field.expert ? " | expert" : "");
}

TEST(Options, SayWhatTheyDoAndWhoNeedsThem) {
  struct Outermost {
    Outer shown, hidden;
    double last = 1e-9;
    std::string name;
    void fields(FieldVisitor& v) {
      v.group("shown", shown);
      v.group("hidden", hidden, kExpert);
      v.number("last", last, "of all [s]", any_value());
      v.text("name", name, "of the box");
    }
  } options;
  std::vector<std::string> got;
  for (const Field& field : describe_fields([&](FieldVisitor& v) { options.fields(v); }))
    got.push_back(description(field));
  const std::vector<std::string> expected = {"shown.width | 0.5 | > 0 | of the box [m]",
                                             "shown.share | 0.25 | 0 to 1 | of the box | expert",
                                             "shown.active | true |  true false | or not",
                                             "shown.colour | green |  red green | of the box",
                                             "shown.cmaes.population | 17 | ≥ 4 | candidates | expert",
                                             "hidden.width | 0.5 | > 0 | of the box [m] | expert",
                                             "hidden.share | 0.25 | 0 to 1 | of the box | expert",
                                             "hidden.active | true |  true false | or not | expert",
                                             "hidden.colour | green |  red green | of the box | expert",
                                             "hidden.cmaes.population | 17 | ≥ 4 | candidates | expert",
                                             "last | 1e-09 |  | of all [s]",
                                             "name |  |  | of the box"};
  EXPECT_EQ(got, expected);
}

TEST(Options, DeviateWhereAnotherValueIsPublished) {
  Kept options;
  const std::vector<Field> list = describe_fields([&](FieldVisitor& v) { options.fields(v); });
  EXPECT_TRUE(list[0].deviates());
  EXPECT_FALSE(list[5].deviates()) << "nothing is published";
  options.width = 0.1;
  EXPECT_FALSE(describe_fields([&](FieldVisitor& v) { options.fields(v); })[0].deviates());
}

TEST(Options, AreSetFromText) {
  Outer options;
  EXPECT_TRUE(set_field(fields_of(options), "width", "+1e-3"));
  EXPECT_TRUE(set_field(fields_of(options), "share", "1"));
  EXPECT_TRUE(set_field(fields_of(options), "active", "false"));
  EXPECT_TRUE(set_field(fields_of(options), "colour", "red"));
  EXPECT_TRUE(set_field(fields_of(options), "cmaes.population", "4"));
  EXPECT_EQ(options.width, 1e-3);
  EXPECT_EQ(options.share, 1);
  EXPECT_FALSE(options.active);
  EXPECT_EQ(options.colour, Colour::red);
  EXPECT_EQ(options.cmaes.population, 4);
}

TEST(Options, AnUnknownNameIsNotFound) {
  Outer options;
  for (const char* name : {"population", "cmaes", "cmaes.", "Width", "", "cmaes.population.x"})
    EXPECT_FALSE(set_field(fields_of(options), name, "1")) << name;
}

TEST(Options, RefusalsNameTheValueAndTheBound) {
  Outer options;
  EXPECT_EQ(refusal(options, "cmaes.population", "0"), "cmaes.population = 0, must be ≥ 4");
  EXPECT_EQ(refusal(options, "cmaes.population", "4.5"), "cmaes.population = 4.5, must be a whole number");
  EXPECT_EQ(refusal(options, "cmaes.population", "-99999999999999999999"), "cmaes.population = -1e+20, must be ≥ 4");
  EXPECT_EQ(refusal(options, "cmaes.population", "99999999999999999999"),
            "cmaes.population = 99999999999999999999, must be within ±9223372036854775807");
  EXPECT_EQ(refusal(options, "cmaes.population", "99999999999999999999x"),
            "cmaes.population = 99999999999999999999x, must be a whole number");
  EXPECT_EQ(refusal(options, "cmaes.population", ""), "cmaes.population = , must be a whole number");
  EXPECT_EQ(refusal(options, "width", "0"), "width = 0, must be > 0");
  EXPECT_EQ(refusal(options, "width", "nan"), "width = nan, must be > 0");
  EXPECT_EQ(refusal(options, "width", "1 m"), "width = 1 m, must be a number");
  EXPECT_EQ(refusal(options, "share", "2"), "share = 2, must be between 0 and 1");
  EXPECT_EQ(refusal(options, "active", "yes"), "active = yes, must be true or false");
  EXPECT_EQ(refusal(options, "colour", "blue"), "colour = blue, must be one of red, green");
  EXPECT_EQ(list_fields(fields_of(options)), [] {
    Outer untouched;
    return list_fields(fields_of(untouched));
  }()) << "what is refused changes nothing";
}

TEST(Options, ViolationsAreAllReported) {
  Outer options;
  EXPECT_TRUE(field_violations(fields_of(options)).empty());
  options.width = -1;
  options.share = kNaN;
  options.cmaes.population = 3;
  const std::vector<std::string> expected = {"width = -1, must be > 0", "share = nan, must be between 0 and 1",
                                             "cmaes.population = 3, must be ≥ 4"};
  EXPECT_EQ(field_violations(fields_of(options)), expected);
}

TEST(Options, HaveConditionsBetweenThem) {
  Outer options{.width = 0.1};
  const Fields nested = [&](FieldVisitor& v) { v.group("box", options); };
  EXPECT_EQ(field_violations(nested), std::vector<std::string>{"box.share = 0.25, must be ≤ width = 0.1"});
  EXPECT_TRUE(set_field(nested, "box.share", "0.2")) << "the other may be set next";
  EXPECT_TRUE(set_field(nested, "box.width", "0.3"));
  EXPECT_TRUE(field_violations(nested).empty());
}

TEST(Options, EveryFieldReadsBackExactly) {
  Outer options{.width = 0.1 + 0.2, .share = 1.0 / 3, .active = false, .colour = Colour::red, .cmaes = {123456789}};
  Outer copy;
  for (const auto& [name, text] : list_fields(fields_of(options))) EXPECT_TRUE(set_field(fields_of(copy), name, text));
  EXPECT_EQ(list_fields(fields_of(copy)), list_fields(fields_of(options)));
  EXPECT_EQ(copy.width, options.width);
  EXPECT_EQ(copy.share, options.share);
}

TEST(ToText, IsShortAndExact) {
  EXPECT_EQ(to_text(0.1), "0.1");
  EXPECT_EQ(to_text(-3), "-3");
  for (const double value : {0.1 + 0.2, 1e-320, 5e-324, 1.7976931348623157e308, -0.0, 1.0 / 3}) {
    double back = 7;
    EXPECT_TRUE(from_text(to_text(value), back)) << value;
    EXPECT_EQ(back, value);
    EXPECT_EQ(std::signbit(back), std::signbit(value));
  }
}

TEST(FromText, RefusesWhatIsNoNumber) {
  double value = 7;
  for (const char* text : {"", "+", "1e", "0x10 ", "1,5", " 1", "1 ", "one", "--1", "+-1"})
    EXPECT_FALSE(from_text(text, value)) << text;
}

TEST(Closest, IsTheNameMeant) {
  const std::vector<std::string> names = {"learner", "prior", "trials", "seed"};
  EXPECT_EQ(closest("trails", names), "trials");
  EXPECT_EQ(closest("sed", names), "seed");
  EXPECT_EQ(closest("learnr", names), "learner");
  EXPECT_EQ(closest("prior", names), "prior");
  EXPECT_EQ(closest("M", {"b", "m"}), "m");
  EXPECT_EQ(closest("c", {"m", "C", "c"}), "c");
  EXPECT_EQ(closest("anything", {}), "");
  EXPECT_EQ(closest("identify", {"centres", "model.identify", "model.gp.identify"}), "model.identify");
  EXPECT_EQ(closest("gp.tolerance", {"gp.centres", "model.gp.tolerance"}), "model.gp.tolerance");
  EXPECT_EQ(did_you_mean("sed", names), ", did you mean 'seed'?");
  EXPECT_EQ(did_you_mean("sed", {}), "");
  EXPECT_EQ(did_you_mean("u", {}), "");
  EXPECT_EQ(did_you_mean("u", {"v"}), ", did you mean 'v'?");
  EXPECT_EQ(did_you_mean("mass", {"m", "l"}), ", did you mean 'm'?");
  EXPECT_EQ(did_you_mean("lr", {"model.lr"}), ", did you mean 'model.lr'?");
  EXPECT_EQ(did_you_mean("stiffness", names), "") << "nothing is like it";
  EXPECT_EQ(did_you_mean("ste", {"set"}), ", did you mean 'set'?") << "letters changed places";
  EXPECT_EQ(did_you_mean("torque", {"toggle", "porch"}), "") << "half of its letters are others";
  EXPECT_EQ(suggestions("sed", {"seed", "prior"}), ", did you mean 'seed'? (known: seed, prior)");
  EXPECT_EQ(suggestions("stiffness", {"seed", "prior"}), " (known: seed, prior)");
}

}  // namespace
}  // namespace rehearse
