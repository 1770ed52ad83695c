#pragma once
// The shape of JSON that others wrote. For the sources of this room.

#include "rehearse/report/files.hpp"

namespace rehearse::report {

/// Throws InvalidInput unless `json` is of the kind of `example`: a text, a number, true or false, an object with the
/// keys of the example, or a list of what is like the example's only element. The value of a key NAME? of the example
/// may be null or missing.
void check_shape(const Json& json, const Json& example);

}  // namespace rehearse::report
