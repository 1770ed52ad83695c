#include "rehearse/learners/black_drops/options.hpp"

#include <map>

#include <gtest/gtest.h>

namespace rehearse::learners::black_drops {
namespace {

std::map<std::string, Field> fields_of(Options options) {
  std::map<std::string, Field> fields;
  for (Field& field : describe_fields([&](FieldVisitor& v) { options.fields(v); }))
    EXPECT_TRUE(fields.emplace(field.name, std::move(field)).second) << field.name << " twice";
  return fields;
}

TEST(BlackDropsOptions, AreValidByDefault) {
  Options options;
  EXPECT_EQ(field_violations([&](FieldVisitor& v) { options.fields(v); }), std::vector<std::string>{});
}

TEST(BlackDropsOptions, TurnOffInPublicationsWhatThePaperHasNot) {
  const auto fields = fields_of({});
  for (const char* name : {"retry.searches", "retry.uncertain_tolerance"})
    EXPECT_EQ(fields.at(name).published.text, "0") << name;
  for (const char* name : {"success_test", "start_from_examples"}) EXPECT_EQ(fields.at(name).published.text, "false");
  EXPECT_EQ(fields.at("first_trial.kind").published.text, "policy");
}

TEST(BlackDropsOptions, OfTheModelAreThoseOfItsKind) {
  EXPECT_TRUE(fields_of({}).contains("model.least_squares_start"));
  const auto without_prior = fields_of({.model = identification::ZeroMean{}});
  EXPECT_TRUE(without_prior.contains("model.gp.integrate_rates"));
  EXPECT_EQ(without_prior.at("model.gp.midpoint").value, "false");
  EXPECT_EQ(fields_of({}).at("model.gp.midpoint").value, "true");
  EXPECT_FALSE(without_prior.contains("model.least_squares_start"));
}

TEST(BlackDropsOptions, HaveBounds) {
  Options options;
  const Fields fields = [&](FieldVisitor& v) { options.fields(v); };
  EXPECT_TRUE(set_field(fields, "retry.searches", "0"));
  EXPECT_EQ(options.retry.searches, 0);
  options.retry.searches = 1001;
  options.prior_searches = 0;
  EXPECT_EQ(field_violations(fields), (std::vector<std::string>{"retry.searches = 1001, must be between 0 and 1000",
                                                                "prior_searches = 0, must be between 1 and 1000"}));
}

}  // namespace
}  // namespace rehearse::learners::black_drops
