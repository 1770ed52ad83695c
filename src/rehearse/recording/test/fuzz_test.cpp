#include <gtest/gtest.h>

#include "rehearse/core/errors.hpp"
#include "rehearse/core/random.hpp"
#include "rehearse/recording/recording.hpp"
#include "rehearse/recording/test/swing.hpp"

namespace rehearse::recording {
namespace {

/// One thing that goes wrong with a file.
std::string mutated(std::string text, Rng& rng) {
  static const std::vector<std::string> pieces = {"nan",
                                                  "-",
                                                  ",",
                                                  "\n",
                                                  "\r",
                                                  "\"",
                                                  ";",
                                                  " ",
                                                  "1e308",
                                                  "-1e308",
                                                  "inf",
                                                  "0",
                                                  "1e-320",
                                                  std::string(1, '\0'),
                                                  "\xFF",
                                                  "q",
                                                  "time",
                                                  "[deg]",
                                                  "99999999999999999999",
                                                  ",,,,",
                                                  "\n\n",
                                                  "-0",
                                                  "0x10",
                                                  "1.5.2",
                                                  "\xEF\xBB\xBF"};
  const auto size = static_cast<Index>(text.size());
  const auto place = [&] { return static_cast<std::size_t>(size > 0 ? rng.below(size) : 0); };
  const std::size_t at = place(), count = static_cast<std::size_t>(rng.below(40));
  switch (rng.below(6)) {
    case 0:
      return text.replace(at, std::min<std::size_t>(count, 3),
                          pieces[static_cast<std::size_t>(rng.below(std::ssize(pieces)))]);
    case 1:
      return text.erase(at, count);
    case 2:
      return text.substr(0, at);
    case 3:
      return text.insert(place(), text.substr(at, count));
    case 4:
      return text.replace(at, 1, 1, static_cast<char>(rng.below(256)));
    default: {
      const int row = static_cast<int>(rng.below(42)) + 1, column = static_cast<int>(rng.below(4)) + 1;
      const std::string cell = pieces[static_cast<std::size_t>(rng.below(std::ssize(pieces)))];
      return std::ranges::count(text, '\n') == 42 && std::ranges::count(text, ',') == 126
                 ? with_cell(text, row, column, cell)
                 : text + cell;
    }
  }
}

TEST(Recording, HostileFilesAreRefusedOrReadToAFiniteEpisode) {
  Index refused = 0, read = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    Rng rng({.seed = seed});
    std::string text = swing_csv();
    for (Index i = rng.below(3); i >= 0; --i) text = mutated(text, rng);
    try {
      const Recording recording = read_recording(text, "log.csv", swing_task());
      const Episode& episode = recording.episode;
      ASSERT_GE(episode.steps(), 1) << text;
      ASSERT_EQ(episode.states.rows(), episode.steps() + 1);
      ASSERT_TRUE(episode.states.allFinite() && episode.actions.allFinite()) << text;
      ASSERT_LE(episode.actions.cwiseAbs().maxCoeff(), 2) << text;
      ++read;
    } catch (const InvalidInput& error) {
      ASSERT_EQ(std::string(error.what()).find("log.csv: "), 0U) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(read, 200);
}

}  // namespace
}  // namespace rehearse::recording
