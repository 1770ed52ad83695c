// libFuzzer's entry: `fuzz_NAME` fuzzes the reader NAME (scripts/fuzz).

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "tests/fuzz/readers.hpp"

namespace {
const rehearse::fuzz::Reader* reader = nullptr;
}

extern "C" int LLVMFuzzerInitialize(int*, char*** argv) {
  const std::string program = std::filesystem::path((*argv)[0]).filename();
  reader = rehearse::fuzz::reader_of(std::string_view(program).substr(program.find('_') + 1));
  if (reader) return 0;
  std::fprintf(stderr, "%s: the program's name must end with _NAME of a reader:", program.c_str());
  for (const auto& each : rehearse::fuzz::readers()) std::fprintf(stderr, " %s", each.name.c_str());
  std::fprintf(stderr, "\n");
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  reader->read({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
