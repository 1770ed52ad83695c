#include "rehearse/system/answers.hpp"

#include <cstdint>
#include <cstring>

#include <gtest/gtest.h>

namespace rehearse::system {
namespace {

TEST(Answers, AnObjectsLineIsFoundBehindOtherLines) {
  const std::string_view written = "loading …\n\n {}\n{\"a\":1}\nlater";
  EXPECT_EQ(object_line(written), written.find("later"));
  EXPECT_EQ(last_line(written.substr(0, object_line(written))), "{\"a\":1}");
  EXPECT_EQ(last_line("{}\n"), "{}");
  for (const std::string_view unfinished : {"", "{", "{\"a\":1}", "print\n{", "print\n\n"})
    EXPECT_EQ(object_line(unfinished), 0U) << unfinished;
}

/// The answer of a program whose changes are the states.
std::string answer_of(const Matrix& X) {
  std::string message;
  write_frame(message, X, Matrix(X.rows(), 0), {});
  return message;
}

TEST(Answers, FramesAreARowCountParametersAndColumns) {
  std::string message = "what was sent before";
  write_frame(message, Matrix{{1, 2}, {3, 4}}, Matrix{{5}, {6}}, Vector{{7}});
  std::int64_t rows = 0;
  std::memcpy(&rows, message.data(), sizeof rows);
  EXPECT_EQ(rows, 2);
  double numbers[7];
  ASSERT_EQ(message.size(), sizeof rows + sizeof numbers);
  std::memcpy(numbers, message.data() + sizeof rows, sizeof numbers);
  EXPECT_EQ(std::vector<double>(numbers, numbers + 7), (std::vector<double>{7, 1, 3, 2, 4, 5, 6}));
}

TEST(Answers, FramesComeInPieces) {
  const Matrix X{{1, -0.5}, {kNaN, 1e300}, {0, 2}};
  const std::string answer = answer_of(X);
  ASSERT_EQ(answer.size(), frame_size(3, 2));
  for (std::size_t size = 0; size < answer.size(); ++size)
    EXPECT_EQ(frame_end(std::string_view(answer).substr(0, size), 3, 2), 0U) << size;
  EXPECT_EQ(frame_end(answer, 3, 2), answer.size());
  Matrix dX(3, 2);
  read_frame(answer, dX);
  EXPECT_EQ(std::memcmp(dX.data(), X.data(), sizeof(double) * 6), 0);
}

TEST(Answers, FramesOfOtherSizesAreNone) {
  const std::string answer = answer_of(Matrix::Ones(3, 2));
  EXPECT_EQ(frame_end(answer, 4, 2), kNoAnswer) << "the count of rows is another";
  EXPECT_EQ(frame_end(answer.substr(0, 1), 4, 2), kNoAnswer) << "that is seen at once";
  EXPECT_EQ(frame_end(answer + "!", 3, 2), kNoAnswer) << "more than was asked for";
  EXPECT_EQ(frame_end("Warning: …", 3, 2), kNoAnswer);
}

TEST(Answers, FramesOfOtherSizesSayWhichTheyHave) {
  const std::string answer = answer_of(Matrix::Ones(3, 2));
  EXPECT_EQ(frame_fault(answer, 4, 2), "it answered n = 3, asked for 4");
  EXPECT_EQ(frame_fault(answer + "!", 3, 2), "it wrote more than the 56 bytes of n = 3");
  EXPECT_EQ(frame_fault("Warning: …", 3, 2), "");
  EXPECT_EQ(frame_fault("No", 3, 2), "");
}

}  // namespace
}  // namespace rehearse::system
