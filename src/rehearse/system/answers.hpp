#pragma once
// The end of a program's answer in its output so far, and batches as raw numbers (docs/programs.md, "Raw numbers"). For
// the sources of this room. Pure functions; any thread.

#include <cstddef>
#include <string>
#include <string_view>

#include "rehearse/core/types.hpp"

namespace rehearse::system {

/// The size that `frame_end`, and `Process::Complete`, return for bytes that no answer begins with.
inline constexpr std::size_t kNoAnswer = ~std::size_t{0};

/// The bytes up to the end of the first line that begins with '{'; 0: it is not all there. A program's own prints are
/// passed over.
std::size_t object_line(std::string_view written);

/// The last line of bytes that end with a line's end, without what is before and without that end.
std::string_view last_line(std::string_view lines);

/// A batch X (n × dx), U (n × du) with φ as raw numbers, in place of `message`.
void write_frame(std::string& message, const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi);

/// The size of the answer to a batch of so many rows of dx states, in bytes.
std::size_t frame_size(Index rows, Index dx);

/// The bytes of that answer at the beginning of `written`; 0: it is not all there; kNoAnswer: it is another's, or more.
std::size_t frame_end(std::string_view written, Index rows, Index dx);

/// A sentence that says why an answer that begins with `written` is wrong; empty: it is no frame at all.
std::string frame_fault(std::string_view written, Index rows, Index dx);

/// The changes dX of such an answer, all of whose bytes are there.
void read_frame(std::string_view answer, MatrixView dX);

}  // namespace rehearse::system
