#include "rehearse/qd/archive_bytes.hpp"

#include <cstring>

#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/core/test/test_tools.hpp"

namespace rehearse::qd {
namespace {

Search filled(Niches niches) {
  Search search{Archive(std::move(niches), 4), 12345, 67, "slider, seed 1"};
  Rng rng({.seed = 3});
  const Index D = search.archive.niches().dimensions();
  for (int i = 0; i < 300; ++i) {
    const Vector descriptor = Vector::NullaryExpr(D, [&] { return rng.uniform(); });
    const Vector solution = Vector::NullaryExpr(4, [&] { return rng.normal(); });
    search.archive.add(search.archive.niches().find(descriptor.data()), rng.normal(), descriptor.data(),
                       solution.data());
  }
  return search;
}

Search of_grid() { return filled(Niches(Grid{{{0, 1}, {0, 1}}, {5, 7}})); }
Search of_cvt() { return filled(Niches(Cvt{.bounds = {{0, 1}, {0, 1}, {0, 1}}, .niches = 40, .samples = 400})); }

TEST(ArchiveBytes, ComeBackExactly) {
  for (const Search& search : {of_grid(), of_cvt()}) {
    const std::string bytes = to_bytes(search);
    const Search back = from_bytes(bytes, "archive.bin");
    EXPECT_TRUE(back.archive.niches() == search.archive.niches());
    EXPECT_EQ(back.evaluations, 12345U);
    EXPECT_EQ(back.failed, 67U);
    EXPECT_EQ(back.about, "slider, seed 1");
    ASSERT_EQ(back.archive.size(), search.archive.size());
    for (Index e = 0; e < search.archive.size(); ++e) {
      EXPECT_EQ(back.archive.niche(e), search.archive.niche(e));
      EXPECT_EQ(back.archive.performance(e), search.archive.performance(e));
      EXPECT_EQ(back.archive.descriptor(e), search.archive.descriptor(e));
      EXPECT_EQ(back.archive.solution(e), search.archive.solution(e));
    }
    EXPECT_EQ(to_bytes(back), bytes);
  }
}

TEST(ArchiveBytes, AnEmptyArchiveIsOneToo) {
  const Search empty{Archive(Niches(Grid{{{0, 1}}, {3}}), 2)};
  EXPECT_EQ(from_bytes(to_bytes(empty), "a").archive.size(), 0);
}

std::string refusal(std::string_view bytes) {
  return message_of<InvalidInput>([&] { from_bytes(bytes, "archive.bin"); });
}

/// Changes bytes and makes the checksum right again: what a hostile file could be.
template <class T>
std::string forged(std::string bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof(T));
  fit_checksum(bytes);
  return bytes;
}

TEST(ArchiveBytes, AnEmptyArchiveAsksForNoMemory) {
  const std::string bytes = to_bytes(Search{Archive(Niches(Grid{{{0, 1}}, {3}}), 2)});
  EXPECT_EQ(refusal(forged(bytes, 40, std::uint64_t{1} << 45)),
            "archive.bin: policies of 35184372088832 numbers, must have at most 10000000");
}

TEST(ArchiveBytes, ForeignFilesAreRefused) {
  for (const char* foreign : {"", "RHS", "trial,return\n1,2\n", "\x89PNG\r\n\x1a\nand so on and so on and so on"})
    EXPECT_EQ(refusal(foreign), "archive.bin: not an archive of Rehearse");
  const std::string bytes = to_bytes(of_grid());
  EXPECT_EQ(refusal(forged(bytes, 8, std::uint32_t{2})),
            "archive.bin: format 2, of another version of Rehearse (this one reads 1)");
  EXPECT_EQ(refusal(forged(bytes, 12, std::uint32_t{0x04030201})),
            "archive.bin: written on a machine of the other byte order");
}

TEST(ArchiveBytes, EveryTruncationIsRefused) {
  const std::string bytes = to_bytes(of_grid());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string line = refusal(std::string_view(bytes).substr(0, size));
    ASSERT_TRUE(line.starts_with("archive.bin: ")) << size << ": " << line;
    ASSERT_EQ(line.find('\n'), std::string::npos);
    const bool cut = line.find("truncated") != std::string::npos;
    ASSERT_EQ(cut, size >= 8) << size << ": " << line;
  }
  EXPECT_EQ(refusal(bytes + "x"), "archive.bin: damaged: the checksum does not fit");
}

TEST(ArchiveBytes, EveryChangedByteIsRefused) {
  for (const Search& search : {of_grid(), of_cvt()}) {
    std::string bytes = to_bytes(search);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      bytes[i] = static_cast<char>(bytes[i] ^ 0x20);
      ASSERT_TRUE(refusal(bytes).starts_with("archive.bin: ")) << i;
      bytes[i] = static_cast<char>(bytes[i] ^ 0x20);
    }
    EXPECT_EQ(refusal(bytes), "");
  }
}

// Contradictions with a right checksum: sizes beyond the file, or that fit by accident, niches out of range or twice,
// bounds.
TEST(ArchiveBytes, AFileThatContradictsItselfIsRefused) {
  const std::string bytes = to_bytes(of_grid());
  for (std::size_t field = 24; field < 72; field += 8)  // about, descriptors, parameters, niches, elites, grid
    for (const std::uint64_t value :
         {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{3}, std::uint64_t{1} << 32, ~std::uint64_t{0}}) {
      const std::string forgery = forged(bytes, field, value);
      if (forgery == bytes) continue;
      ASSERT_TRUE(refusal(forgery).starts_with("archive.bin: ")) << field << ' ' << value;
    }
  const std::size_t bounds = 88 + std::strlen("slider, seed 1"), elites = bounds + 2 * 16 + 2 * 8;
  EXPECT_NE(refusal(forged(bytes, bounds, 2.0)).find("bounds [2, 1]"), std::string::npos);
  EXPECT_NE(refusal(forged(bytes, bounds + 32, std::uint64_t{6})).find("another number of niches"), std::string::npos);
  EXPECT_EQ(refusal(forged(bytes, elites, std::uint32_t{35})), "archive.bin: elite 1 contradicts the rest");
  std::uint32_t second = 0;
  std::memcpy(&second, bytes.data() + elites + 4 + 8 * 7, 4);
  EXPECT_EQ(refusal(forged(bytes, elites, second)), "archive.bin: elite 2 contradicts the rest");
}

}  // namespace
}  // namespace rehearse::qd
