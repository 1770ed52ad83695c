#include "rehearse/report/json_shape.hpp"

#include <gtest/gtest.h>

namespace rehearse::report {
namespace {

std::string shape_error(const char* json, const char* example) {
  try {
    check_shape(Json::parse(json), Json::parse(example));
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "";
}

TEST(JsonShape, IsThatOfTheExample) {
  const char* example = R"({"name": "", "size": 0, "good": true, "parts": [{"x": 0}]})";
  EXPECT_EQ(shape_error(R"({"name": "a", "size": 2.5, "good": false, "parts": [], "more": null})", example), "");
  EXPECT_EQ(shape_error(R"({"name": "a", "size": 2, "good": true, "parts": [{"x": 1}, {"x": 2}]})", example), "");
  EXPECT_EQ(shape_error(R"({"name": 1, "size": "", "good": 0, "parts": {}})", example),
            "name must be a text\nsize must be a number\ngood must be true or false\nparts must be a list");
  EXPECT_EQ(shape_error("{}", R"({"a": {"b": 0}})"), "a must be an object");
  EXPECT_EQ(shape_error(R"({"a": {}})", R"({"a": {"b": 0}})"), "a.b must be a number");
}

TEST(JsonShape, NamesTheFirstWrongElementOfAList) {
  EXPECT_EQ(shape_error(R"({"parts": [{"x": 1}, {"x": null}, 3]})", R"({"parts": [{"x": 0}]})"),
            "parts[1].x must be a number");
}

TEST(JsonShape, MayLackWhatIsOptional) {
  const char* example = R"({"low?": 0, "of?": {"x": 0}})";
  EXPECT_EQ(shape_error("{}", example), "");
  EXPECT_EQ(shape_error(R"({"low": null, "of": null})", example), "");
  EXPECT_EQ(shape_error(R"({"low": "", "of": {}})", example), "low must be a number\nof.x must be a number");
}

}  // namespace
}  // namespace rehearse::report
