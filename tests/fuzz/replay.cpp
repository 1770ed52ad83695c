// replay NAME FOLDER COUNT: gives a reader each file of a folder, and COUNT inputs in all that are those files with
// random changes, the same ones every time. Whatever the reader throws that is no refusal ends it. So does a reader
// that refuses them all: nothing behind its first check would be tested.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "rehearse/files/regular_file.hpp"
#include "tests/fuzz/readers.hpp"

namespace {

using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t n) { return n == 0 ? 0 : random() % n; }

/// One change: bytes flipped, removed, repeated, replaced by a number that hurts, or taken from another example.
void change(std::string& bytes, const std::vector<std::string>& examples, Random& random) {
  static const std::vector<std::string> hurtful{"-1",       "0",
                                                "-0",       "1e999",
                                                "1e308",    "-1e308",
                                                "1e-320",   "nan",
                                                "inf",      "9223372036854775807",
                                                "0x10",     "1.5.2",
                                                "\"",       "[",
                                                "{",        ";",
                                                " ",        "q",
                                                "\n",       "\n\n",
                                                "\r",       ",",
                                                ",,,,",     "time",
                                                "[deg]",    std::string(1, '\0'),
                                                "\xff\xfe", "\xEF\xBB\xBF"};
  const std::size_t at = below(random, bytes.size() + 1),
                    length = below(random, std::min<std::size_t>(bytes.size() - at, 32) + 1);
  switch (random() % 5) {
    case 0:
      if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
      break;
    case 1:
      bytes.erase(at, length);
      break;
    case 2:
      bytes.insert(at, bytes.substr(at, length));
      break;
    case 3:
      bytes.replace(at, length, hurtful[below(random, hurtful.size())]);
      break;
    default: {
      const std::string& other = examples[below(random, examples.size())];
      const std::size_t from = below(random, other.size() + 1);
      bytes.replace(at, length, other.substr(from, below(random, 64)));
    }
  }
}

}  // namespace

int main(int argc, char** argv) try {
  const rehearse::fuzz::Reader* reader = argc == 4 ? rehearse::fuzz::reader_of(argv[1]) : nullptr;
  if (!reader) return std::fprintf(stderr, "replay NAME FOLDER COUNT\n"), 2;
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(argv[2])) paths.push_back(entry.path());
  std::ranges::sort(paths);
  std::vector<std::string> examples;
  for (const auto& path : paths) examples.push_back(rehearse::files::read_file(path));
  if (examples.empty()) return std::fprintf(stderr, "%s has no example\n", argv[2]), 2;
  std::size_t read = 0;
  for (const std::string& example : examples) (void)reader->read(example);
  Random random(1);
  const std::size_t count = std::strtoul(argv[3], nullptr, 10);
  for (std::size_t i = 0; i < count; ++i) {
    std::string bytes = examples[i % examples.size()];
    for (std::size_t changes = 1 + below(random, 4); changes > 0; --changes) change(bytes, examples, random);
    read += reader->read(bytes);
  }
  std::printf("%s: %zu examples, %zu inputs made of them, of which it reads %zu\n", argv[1], examples.size(), count,
              read);
  return read > 0 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s: %s\n", argv[1], error.what());
  return 1;
}
