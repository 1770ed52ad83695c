#pragma once
// Readers of foreign bytes: files of users and of run folders, and programs' answers.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace rehearse::fuzz {

/// A reader under test. `read` says whether the bytes were read, or refused as the program refuses them; whatever it
/// throws is a finding. Any order of calls; one thread.
struct Reader {
  std::string name;  // of its folder of examples, too
  std::function<bool(std::string_view)> read;
};

const std::vector<Reader>& readers();

/// Null: there is none.
const Reader* reader_of(std::string_view name);

}  // namespace rehearse::fuzz
