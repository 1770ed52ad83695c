#pragma once
// The messages to and from programs (docs/programs.md). For the sources of this room.

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "rehearse/core/types.hpp"
#include "rehearse/system/program.hpp"

namespace rehearse::system::messages {

inline constexpr int kVersion = 1;

/// A program's answer to the first message.
struct Hello {
  bool doubles = false;                                          // its changes come as raw numbers
  bool change = true, reset = false, step = false, end = false;  // the messages that it understands
};

std::string hello(const Program& program);
std::string change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi);
std::string reset(const Vector& start, const Vector& phi, std::uint64_t seed);
std::string step(const Vector& u);
std::string end();

/// The program answered that it cannot.
struct Declined : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Readers of answers. They throw std::runtime_error with what is wrong.
Hello read_hello(std::string_view text, const Program& program);
void read_change(std::string_view text, MatrixView dX);  // rows that are null, or have one, are NaN
struct State {
  Vector measured;
  Vector truth;  // empty: the program does not know
};
State read_state(std::string_view text, Index size);
void read_end(std::string_view text);

/// A line, or what it begins with, for messages to people.
std::string excerpt(std::string_view text);

}  // namespace rehearse::system::messages
