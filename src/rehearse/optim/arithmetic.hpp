#pragma once

#include <string>

namespace rehearse::optim {

/// What of this machine's processor decides the last bits of results, in words.
std::string arithmetic();

}  // namespace rehearse::optim
