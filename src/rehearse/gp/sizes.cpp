#include "rehearse/gp/sizes.hpp"

#include <fmt/format.h>

#include "rehearse/core/errors.hpp"

namespace rehearse::gp {

void require_size(const char* name, Index value, Index bound) {
  if (value != bound) throw InvalidInput(fmt::format("gp {} = {}, must be {}", name, value, bound));
}

void require_shape(const char* name, Index rows, Index columns, Index expected_rows, Index expected_columns) {
  if (rows == expected_rows && columns == expected_columns) return;
  throw InvalidInput(
      fmt::format("gp {} is {} × {}, must be {} × {}", name, rows, columns, expected_rows, expected_columns));
}

}  // namespace rehearse::gp
