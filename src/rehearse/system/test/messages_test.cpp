#include "rehearse/system/messages.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "rehearse/system/test/programs.hpp"

namespace rehearse::system::messages {
namespace {

TEST(Messages, AreLinesWithNumbersThatAreFloatingPoint) {
  const Matrix X{{1, 0.1}, {-2e300, 3}}, U{{0}, {0.5}};
  EXPECT_EQ(change(X, U, Vector{{7}}),
            "{\"change\":{\"states\":[[1.0,0.1],[-2e+300,3.0]],\"actions\":[[0.0],[0.5]],\"parameters\":[7.0]}}\n");
  EXPECT_EQ(reset(Vector{{1}}, Vector{}, 12), "{\"reset\":{\"state\":[1.0],\"parameters\":[],\"seed\":12}}\n");
  EXPECT_EQ(step(Vector{{-1, 2}}), "{\"step\":{\"action\":[-1.0,2.0]}}\n");
}

TEST(Messages, NumbersGoRoundToTheBit) {
  Matrix X(50, 1), back(50, 1);
  for (Index i = 0; i < 50; ++i)
    X(i, 0) = std::sin(static_cast<double>(i) * 1.7) * std::pow(10, static_cast<double>(i % 20) - 10);
  std::string text = change(X, Matrix(50, 0), {});
  const std::size_t from = text.find("[["), to = text.find("]]") + 2;
  read_change("{\"change\":" + text.substr(from, to - from) + "}", back);
  EXPECT_EQ(back, X);
}

TEST(Messages, WrongAnswersSayWhatIsWrong) {
  const auto why = [](const std::string& text) -> std::string {
    Matrix dX(2, 2);
    try {
      read_change(text, dX);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(why("{\"change\":[[1,2],[3,4]]}"), "");
  EXPECT_EQ(why("{\"change\":[[1,2],null]}"), "");
  EXPECT_EQ(why("{\"change\":[[1,2]]}"),
            "\"change\" of its answer must be a list of 2 rows, one for each that was asked, not of 1");
  EXPECT_EQ(why("{\"change\":[[1,2],[3]]}"), "\"change\" of its answer must be a list of 2 numbers, not [3]");
  EXPECT_EQ(why("{\"change\":7}"),
            "\"change\" of its answer must be a list of 2 rows, one for each that was asked, not 7");
  EXPECT_EQ(why("{\"changes\":[]}"), "its answer has no \"change\": {\"changes\":[]}");
  EXPECT_EQ(why("{\"change\":[[1,2],[3,"), "it answered what is no JSON: {\"change\":[[1,2],[3,");
  EXPECT_EQ(why("{\"error\":\"no\"}"), "it answered an error: no");
  EXPECT_EQ(why("{\"change\":[[1,2],[3,\"4\"]]}"),
            "\"change\" of its answer has \"4\", which is neither a number nor null");
  EXPECT_EQ(why("{\"change\":[[1,2],[true,4]]}"),
            "\"change\" of its answer has true, which is neither a number nor null");
  EXPECT_THROW(read_state("{\"state\":[1,\"b\"]}", 2), std::runtime_error);
  EXPECT_THROW(read_state("{\"state\":[1]}", 2), std::runtime_error);
  EXPECT_EQ(read_state("{\"state\":[1,2]}", 2).truth.size(), 0);
}

// Python's json writes these.
TEST(Messages, NumbersThatAreNoneAreNull) {
  Matrix dX(3, 2);
  read_change("{\"note\":\"NaN \\\" Infinity\",\"change\":[[NaN,-Infinity],[1,Infinity],[-2,3]]}", dX);
  EXPECT_TRUE(dX.row(0).array().isNaN().all());
  EXPECT_EQ(dX(1, 0), 1);
  EXPECT_TRUE(std::isnan(dX(1, 1)));
  EXPECT_EQ(dX.row(2), (Eigen::RowVector2d(-2, 3)));
  EXPECT_TRUE(std::isnan(read_state("{\"state\":[NaN]}", 1).measured(0)));
  try {
    read_change("{\"error\":\"NaN \\\" Infinity\",\"change\":NaN}", dX);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "it answered an error: NaN \" Infinity");
  }
  for (const char* text : {"{\"change\":[Nan]}", "{\"change\":[NaN}", "{\"change\":\"NaN", "{\"change\":\"\\"})
    EXPECT_THROW(read_change(text, dX), std::runtime_error) << text;
}

// Each of these went into a function that calls itself for every bracket.
TEST(Messages, DeepAnswersAreRefused) {
  const std::string deep = std::string(400'000, '[') + std::string(400'000, ']');
  const auto expect_refused = [](const auto& read) {
    try {
      read();
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).find("it answered lists within lists, more than 16 deep: {\""), 0u);
      EXPECT_LT(std::string(error.what()).size(), 250u);
    }
  };
  const Program program{.states = {"a"}, .actions = {"u"}, .dt_s = 0.1};
  for (const char* start : {"{\"rehearse\":", "{\"rehearse\":1,\"states\":", "{\"rehearse\":1,\"encoding\":",
                            "{\"rehearse\":1,\"messages\":[", "{\"error\":"})
    expect_refused([&] { read_hello(start + deep + "}", program); });
  Matrix dX(2, 2);
  expect_refused([&] { read_change("{\"change\":" + deep + "}", dX); });
  expect_refused([&] { read_change("{\"error\":" + deep, dX); });
  expect_refused([&] { read_state("{\"state\":" + deep + "}", 2); });
}

TEST(Messages, ALongErrorIsCutAndHasNoEscapes) {
  const auto why = [](const std::string& error) -> std::string {
    try {
      read_end("{\"error\":" + error + "}");
    } catch (const Declined& declined) {
      return declined.what();
    }
    return "";
  };
  EXPECT_EQ(why("\"line 1\\nline\\u001b 2\""), "it answered an error: line 1\nline? 2");
  EXPECT_EQ(why("\"" + std::string(1000, 'x') + "\""), "it answered an error: " + std::string(1000, 'x'));
  EXPECT_EQ(why("\"" + std::string(9000, 'x') + "\""), "it answered an error: " + std::string(1000, 'x') + " …");
  EXPECT_LT(why("[\"" + std::string(9000, 'x') + "\"]").size(), 1100u);
}

TEST(Messages, ALongLineIsCutAndHasNoEscapes) {
  EXPECT_EQ(excerpt("a\033[31mb"), "a?[31mb");
  EXPECT_EQ(excerpt("θ\xff\xce"), "θ??");
  EXPECT_LT(excerpt(std::string(1000, 'x')).size(), 130u);
}

}  // namespace
}  // namespace rehearse::system::messages
