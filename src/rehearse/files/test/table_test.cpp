#include "rehearse/files/table.hpp"

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::files {
namespace {

std::string complaint(const std::string& text) {
  try {
    read_csv(text).numbers("b");
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST(Table, ReadsCells) {
  const Table table = read_csv("a,b,c\n1,2.5,\n\"say \"\"no\"\", twice\n\",\"\"\"\",\"\"\n");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.header, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"1", "2.5", ""}));
  EXPECT_EQ(table.rows[1], (std::vector<std::string>{"say \"no\", twice\n", "\"", ""}));
  EXPECT_EQ(table.column("c"), 2);
  EXPECT_EQ(table.column("d"), -1);
}

TEST(Table, ReadsNumbers) {
  const auto numbers = read_csv("a,b\r\n1,1e-05\r\n2,\r\n").numbers("b");
  ASSERT_EQ(numbers.size(), 2u);
  EXPECT_EQ(numbers[0], 1e-05);
  EXPECT_FALSE(numbers[1].has_value());
  EXPECT_EQ(read_csv("a,b\n1,x\n2,\n").texts("b"), (std::vector<std::string>{"x", ""}));
}

TEST(Table, EveryTruncationIsNoticedOrLosesWholeRows) {
  const std::string text = "a,b\n1,\"x\"\"y\"\n2,30\n";
  for (std::size_t size = 0; size < text.size(); ++size) {
    const std::string cut = text.substr(0, size);
    if (cut.ends_with('\n'))
      EXPECT_LT(read_csv(cut).rows.size(), 2u) << size;
    else
      EXPECT_THROW(read_csv(cut), InvalidInput) << size;
  }
}

TEST(Table, SaysWhatIsWrong) {
  EXPECT_EQ(complaint(""), "the table is empty");
  EXPECT_EQ(complaint("a,b\n1,2\n1,2,3\n"),
            "row 3 has 3 cells, the header has 2: decimals need a point, columns a comma");
  EXPECT_EQ(complaint("a,b\n1,2"), "row 2 is cut short");
  EXPECT_EQ(complaint("a,c\n1,2\n"), "there is no column b");
  EXPECT_EQ(complaint("a,b\n1,many\n"), "column b: 'many' is no number");
}

}  // namespace
}  // namespace rehearse::files
