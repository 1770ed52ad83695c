#include "rehearse/system/answers.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>

namespace rehearse::system {
namespace {

static_assert(std::endian::native == std::endian::little, "raw numbers are little-endian");

std::size_t bytes_of(Index numbers) { return sizeof(double) * static_cast<std::size_t>(numbers); }

void append(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

void append_columns(std::string& bytes, const ConstMatrixView& rows) {
  for (Index c = 0; c < rows.cols(); ++c) append(bytes, rows.col(c).data(), bytes_of(rows.rows()));
}

}  // namespace

std::size_t object_line(std::string_view written) {
  for (std::size_t at = 0;;) {
    const std::size_t end = written.find('\n', at);
    if (end == std::string_view::npos) return 0;
    if (written[at] == '{') return end + 1;
    at = end + 1;
  }
}

std::string_view last_line(std::string_view lines) {
  lines.remove_suffix(1);
  const std::size_t before = lines.rfind('\n');
  return before == std::string_view::npos ? lines : lines.substr(before + 1);
}

void write_frame(std::string& message, const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi) {
  const std::int64_t rows = X.rows();
  message.clear();
  append(message, &rows, sizeof rows);
  append(message, phi.data(), bytes_of(phi.size()));
  append_columns(message, X);
  append_columns(message, U);
}

std::size_t frame_size(Index rows, Index dx) { return sizeof(std::int64_t) + bytes_of(rows * dx); }

std::size_t frame_end(std::string_view written, Index rows, Index dx) {
  const std::int64_t expected = rows;
  const std::size_t known = std::min(written.size(), sizeof expected), size = frame_size(rows, dx);
  if (written.size() > size || std::memcmp(written.data(), &expected, known) != 0) return kNoAnswer;
  return written.size() == size ? size : 0;
}

std::string frame_fault(std::string_view written, Index rows, Index dx) {
  constexpr std::int64_t kMost = 1 << 30;  // letters as a number are larger
  std::int64_t answered = 0;
  if (written.size() < sizeof answered) return {};
  std::memcpy(&answered, written.data(), sizeof answered);
  if (answered == rows) return fmt::format("it wrote more than the {} bytes of n = {}", frame_size(rows, dx), rows);
  if (answered > kMost || answered < -kMost) return {};
  return fmt::format("it answered n = {}, asked for {}", answered, rows);
}

void read_frame(std::string_view answer, MatrixView dX) {
  const char* at = answer.data() + sizeof(std::int64_t);
  for (Index c = 0; c < dX.cols(); ++c, at += bytes_of(dX.rows()))
    std::memcpy(dX.col(c).data(), at, bytes_of(dX.rows()));
}

}  // namespace rehearse::system
