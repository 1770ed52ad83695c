#include "rehearse/system/messages.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "rehearse/core/text_table.hpp"

namespace rehearse::system::messages {
namespace {

using Json = nlohmann::json;

constexpr int kDeepest = 16;

template <class... Args>
[[noreturn]] void refuse(fmt::format_string<Args...> format, Args&&... args) {
  throw std::runtime_error(fmt::format(format, std::forward<Args>(args)...));
}

/// The beginning of a text; what is no character, or none to print, is a question mark. Line ends stay.
std::string beginning(std::string_view text, std::size_t most) {
  std::string part(text.substr(0, most));
  for (std::size_t at = 0; at < part.size();) {
    const std::size_t size = character_at(part, at);
    const auto byte = static_cast<unsigned char>(part[at]);
    if (size == 0 || (size == 1 && part[at] != '\n' && (byte < 32 || byte == 127))) part[at] = '?';
    at += std::max<std::size_t>(size, 1);
  }
  return part;
}

/// An error may be a traceback of many lines, and its whole text goes into messages and into the run's warnings.
std::string shortened(const std::string& error) {
  constexpr std::size_t kMost = 1000;  // bytes
  return beginning(error, kMost) + (error.size() > kMost ? " …" : "");
}

/// Numbers that JSON's readers take for floating-point ones: 1.0, not 1.
void write(std::string& text, double value) {
  if (!std::isfinite(value)) {
    text += "null";
    return;
  }
  const std::size_t from = text.size();
  fmt::format_to(std::back_inserter(text), "{}", value);
  if (text.find_first_of(".e", from) == std::string::npos) text += ".0";
}

template <class Values>
void write_list(std::string& text, const Values& values) {
  text += '[';
  for (Index i = 0; i < values.size(); ++i) {
    if (i > 0) text += ',';
    write(text, values(i));
  }
  text += ']';
}

void write_rows(std::string& text, const ConstMatrixView& rows) {
  text += '[';
  for (Index i = 0; i < rows.rows(); ++i) {
    if (i > 0) text += ',';
    write_list(text, rows.row(i));
  }
  text += ']';
}

/// Discarded where it is no JSON. Copies and texts of a value recurse: one that is nested deeply enough would exhaust
/// the stack.
Json parsed(std::string_view text) {
  bool too_deep = false;
  const auto is_flat = [&](int depth, Json::parse_event_t, const Json&) { return !(too_deep |= depth > kDeepest); };
  Json json = Json::parse(text, is_flat, false);
  if (too_deep) refuse("it answered lists within lists, more than {} deep: {}", kDeepest, excerpt(text));
  return json;
}

/// A text whose numbers that are none, as Python's json writes them, are null.
std::string with_nulls(std::string_view text) {
  std::string json;
  bool quoted = false;
  while (!text.empty()) {
    std::size_t taken = quoted && text.starts_with('\\') ? 2 : 1;
    if (text.starts_with('"')) quoted = !quoted;
    for (const std::string_view number : {"NaN", "-Infinity", "Infinity"})
      if (!quoted && text.starts_with(number)) taken = number.size();
    json += taken > 2 ? "null" : text.substr(0, taken);
    text.remove_prefix(std::min(taken, text.size()));
  }
  return json;
}

Json object_of(std::string_view text) {
  Json json = parsed(text);
  if (json.is_discarded()) json = parsed(with_nulls(text));
  if (json.is_discarded()) refuse("it answered what is no JSON: {}", excerpt(text));
  if (!json.is_object()) refuse("it answered what is no JSON object: {}", excerpt(text));
  if (const auto error = json.find("error"); error != json.end())
    throw Declined("it answered an error: " +
                   shortened(error->is_string() ? error->get<std::string>() : error->dump()));
  return json;
}

const Json& member(const Json& object, const char* key, std::string_view text) {
  const auto found = object.find(key);
  if (found == object.end()) refuse("its answer has no \"{}\": {}", key, excerpt(text));
  return *found;
}

double number_of(const Json& json, const char* key) {
  if (json.is_null()) return kNaN;
  if (!json.is_number())
    refuse("\"{}\" of its answer has {}, which is neither a number nor null", key, excerpt(json.dump()));
  return json.get<double>();
}

Vector vector_of(const Json& json, const char* key, Index size) {
  if (!json.is_array() || static_cast<Index>(json.size()) != size)
    refuse("\"{}\" of its answer must be a list of {} numbers, not {}", key, size, excerpt(json.dump()));
  Vector values(size);
  for (Index i = 0; i < size; ++i) values(i) = number_of(json[static_cast<std::size_t>(i)], key);
  return values;
}

/// A program may repeat names, so that a mistaken order is found.
void require_same(const Json& object, const char* key, const std::vector<std::string>& names) {
  const auto given = object.find(key);
  if (given == object.end()) return;
  if (*given != Json(names))
    refuse("its {} are {}, the robot's file has [{}]", key, given->dump(), fmt::join(names, ", "));
}

void read_messages(const Json& object, Hello& hello) {
  const auto messages = object.find("messages");
  if (messages == object.end()) return;
  hello.change = hello.reset = hello.step = hello.end = false;
  for (const Json& each : *messages) {
    if (each == "change")
      hello.change = true;
    else if (each == "reset")
      hello.reset = true;
    else if (each == "step")
      hello.step = true;
    else if (each == "end")
      hello.end = true;
    else
      refuse("it understands the message {}; there are \"change\", \"reset\", \"step\" and \"end\"", each.dump());
  }
  if (hello.reset != hello.step) refuse("\"reset\" and \"step\" go together");
  if (hello.end && !hello.step) refuse("\"end\" goes with \"reset\" and \"step\"");
}

}  // namespace

std::string excerpt(std::string_view text) {
  constexpr std::size_t kMost = 120;
  const std::string line = beginning(text.substr(0, text.find('\n')), kMost);
  return line + (text.size() > line.size() + 1 ? " …" : "");
}

std::string hello(const Program& program) {
  const Json message = {{"rehearse", kVersion},
                        {"states", program.states},
                        {"actions", program.actions},
                        {"parameters", program.parameters},
                        {"dt_s", program.dt_s}};
  return message.dump() + "\n";
}

std::string change(const ConstMatrixView& X, const ConstMatrixView& U, const Vector& phi) {
  std::string text = R"({"change":{"states":)";
  write_rows(text, X);
  text += R"(,"actions":)";
  write_rows(text, U);
  text += R"(,"parameters":)";
  write_list(text, phi);
  return text += "}}\n";
}

std::string reset(const Vector& start, const Vector& phi, std::uint64_t seed) {
  std::string text = R"({"reset":{"state":)";
  write_list(text, start);
  text += R"(,"parameters":)";
  write_list(text, phi);
  return text + fmt::format(R"(,"seed":{}}}}})", seed) + "\n";
}

std::string step(const Vector& u) {
  std::string text = R"({"step":{"action":)";
  write_list(text, u);
  return text += "}}\n";
}

std::string end() { return "{\"end\":{}}\n"; }

void read_end(std::string_view text) { member(object_of(text), "end", text); }

Hello read_hello(std::string_view text, const Program& program) {
  const Json object = object_of(text);
  if (const Json& version = member(object, "rehearse", text); version != kVersion)
    refuse("it speaks version {} of the messages, this is version {}", version.dump(), kVersion);
  require_same(object, "states", program.states);
  require_same(object, "actions", program.actions);
  require_same(object, "parameters", program.parameters);
  Hello hello;
  const std::string encoding = object.value("encoding", Json("json")).dump();
  hello.doubles = encoding == R"("doubles")";
  if (!hello.doubles && encoding != R"("json")")
    refuse("it wants the encoding {}; there are \"json\" and \"doubles\"", encoding);
  read_messages(object, hello);
  return hello;
}

void read_change(std::string_view text, MatrixView dX) {
  const Json object = object_of(text);
  const Json& rows = member(object, "change", text);
  if (!rows.is_array() || static_cast<Index>(rows.size()) != dX.rows())
    refuse("\"change\" of its answer must be a list of {} rows, one for each that was asked, not {}", dX.rows(),
           rows.is_array() ? fmt::format("of {}", rows.size()) : excerpt(rows.dump()));
  for (Index i = 0; i < dX.rows(); ++i) {
    const Json& row = rows[static_cast<std::size_t>(i)];
    if (row.is_null())
      dX.row(i).setConstant(kNaN);
    else
      dX.row(i) = vector_of(row, "change", dX.cols()).transpose();
  }
}

State read_state(std::string_view text, Index size) {
  const Json object = object_of(text);
  State state{vector_of(member(object, "state", text), "state", size), {}};
  if (const auto truth = object.find("truth"); truth != object.end()) state.truth = vector_of(*truth, "truth", size);
  return state;
}

}  // namespace rehearse::system::messages
