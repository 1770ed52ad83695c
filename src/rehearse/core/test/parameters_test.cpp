#include "rehearse/core/parameters.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "test_tools.hpp"

namespace rehearse {
namespace {

ParameterSpace space() {
  return ParameterSpace({Parameter::fixed("gravity", 9.82), Parameter::continuous("mass", 0.5, {0.1, 1}),
                         Parameter::discrete("legs", 2, {2, 4, 6})});
}

TEST(ParameterSpace, KnowsItsParameters) {
  const ParameterSpace s = space();
  EXPECT_EQ(s.size(), 3);
  EXPECT_EQ(s.values(), (Vector{{9.82, 0.5, 2}}));
  EXPECT_EQ(s.names(), (std::vector<std::string>{"gravity", "mass", "legs"}));
  EXPECT_EQ(s.find("legs"), 2);
  EXPECT_EQ(s.find("leg"), -1);
  EXPECT_EQ(s.of_kind(Parameter::Kind::fixed), std::vector<Index>{0});
  EXPECT_EQ(s.of_kind(Parameter::Kind::continuous), std::vector<Index>{1});
  EXPECT_EQ(s.of_kind(Parameter::Kind::discrete), std::vector<Index>{2});
  EXPECT_TRUE(s.has_tunable());
  EXPECT_EQ(ParameterSpace().size(), 0);
  EXPECT_FALSE(ParameterSpace().has_tunable());
}

TEST(ParameterSpace, FixedAtKeepsNamesAndTakesValues) {
  const ParameterSpace s = space().fixed_at(Vector{{9.81, 0.7, 4}});
  EXPECT_FALSE(s.has_tunable());
  EXPECT_EQ(s.values(), (Vector{{9.81, 0.7, 4}}));
  EXPECT_EQ(s.names(), space().names());
}

TEST(ParameterSpace, TunableInKeepsValuesAndUnits) {
  const ParameterSpace fixed({Parameter::fixed("m", 0.5, "kg"), Parameter::fixed("l", 0.4, "m")});
  const ParameterSpace s = fixed.tunable_in({0.1, 1}, {"l"});
  EXPECT_EQ(s.values(), fixed.values());
  EXPECT_EQ(s.of_kind(Parameter::Kind::continuous), std::vector<Index>{1});
  EXPECT_EQ(s[1].unit, "m");
  EXPECT_EQ(s[1].box.low, 0.1);
  EXPECT_EQ(s[1].box.high, 1);
  EXPECT_EQ(message_of<InvalidInput>([&] {
              fixed.tunable_in({0.45, 1}, {"m", "l"});
            }),
            "l = 0.4, must be between 0.45 and 1");
  EXPECT_EQ(message_of<InvalidInput>([&] {
              fixed.tunable_in({0, 1}, {"n"});
            }),
            "unknown parameter 'n', did you mean 'm'? (known: m, l)");
}

TEST(ParameterSpace, ValuesStayInTheirBoxOrSet) {
  ParameterSpace s = space();
  s.set_value("mass", 1);
  s.set_value("legs", 6);
  s.set_value("gravity", 1.6);
  EXPECT_EQ(s.values(), (Vector{{1.6, 1, 6}}));
  EXPECT_EQ(message_of<InvalidInput>([&] { s.set_value("mass", 2); }), "mass = 2, must be between 0.1 and 1");
  EXPECT_EQ(message_of<InvalidInput>([&] { s.set_value("legs", 3); }), "legs = 3, must be one of 2, 4, 6");
  EXPECT_EQ(message_of<InvalidInput>([&] { s.set_value("mass", kNaN); }), "mass = nan, must be finite");
  EXPECT_EQ(message_of<InvalidInput>([&] { s.set_value("mas", 1); }),
            "unknown parameter 'mas', did you mean 'mass'? (known: gravity, mass, legs)");
  EXPECT_EQ(s.values(), (Vector{{1.6, 1, 6}})) << "what is refused changes nothing";
}

TEST(ParameterSpace, BadParametersAreAllReported) {
  const std::string text = message_of<InvalidInput>([] {
    ParameterSpace({Parameter::fixed("", 1), Parameter::fixed("a", 1), Parameter::fixed("a", 2),
                    Parameter::continuous("b", 0, {1, 1}), Parameter::discrete("c", 0, {}),
                    Parameter::continuous("d", 5, {0, 1}), Parameter::discrete("e", 1, {1, kNaN, 2, 1})});
  });
  EXPECT_EQ(text.find("must be one of \n"), std::string::npos) << text;
  for (const char* line :
       {"parameter 0 has no name", "parameter a appears twice", "parameter b needs a finite box with low < high",
        "parameter c has no choices", "d = 5, must be between 0 and 1", "parameter e: choice nan must be finite",
        "parameter e: choice 1 appears twice"})
    EXPECT_NE(text.find(line), std::string::npos) << line << " in\n" << text;
}

}  // namespace
}  // namespace rehearse
