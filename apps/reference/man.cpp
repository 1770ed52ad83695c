#include <cctype>

#include <fmt/format.h>

#include "apps/reference/pages.hpp"

namespace rehearse::apps {
namespace {

constexpr const char* kEnd = R"(.SH "EXIT STATUS"
0 for success, 1 where something failed, 2 for wrong input, and 128 + the
signal where one stopped it.
)";

constexpr const char* kEnvironment = R"(.SH ENVIRONMENT
.TP
.B REHEARSE_CACHE
The folder of what long preparations made, or
.B off
for none.
Without it,
.I rehearse
in
.B XDG_CACHE_HOME
or in
.IR ~/.cache .
.SH FILES
.TP
.I /usr/share/doc/rehearse/examples
Robots by equations, by models of MuJoCo and by programs, and campaigns.
)";

constexpr std::size_t kWidth = 78;

/// The code point of the UTF-8 sequence that begins at `at`, which moves to its last byte.
unsigned code_point(const std::string& text, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const int more = byte(at) >= 0xF0 ? 3 : byte(at) >= 0xE0 ? 2 : 1;
  unsigned code = byte(at) & (0x3Fu >> more);
  for (int i = 0; i < more && at + 1 < text.size(); ++i) code = code << 6 | (byte(++at) & 0x3Fu);
  return code;
}

/// Text that roff prints as it is; `words` in backticks are bold. Bytes that are not ASCII become named characters.
std::string roff(const std::string& text, bool bold_words) {
  std::string escaped;
  bool bold = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-' || c == '\'' || c == '`' || c == '~' || c == '^')
      escaped += c == '`' && bold_words ? ((bold = !bold) ? "\\fB" : "\\fR")
                 : c == '-'             ? "\\-"
                 : c == '\''            ? "\\(aq"
                 : c == '~'             ? "\\(ti"
                 : c == '^'             ? "\\(ha"
                                        : "\\(ga";
    else if (static_cast<unsigned char>(c) < 0x80)
      escaped += c;
    else
      escaped += fmt::format("\\[u{:04X}]", code_point(text, at));
  }
  return escaped;
}

/// A line of text never begins with a dot, which would be a request.
std::string guarded(const std::string& line) { return line.starts_with('.') ? "\\&" + line : line; }

/// Running text in lines of at most kWidth bytes, where words allow.
std::string filled(const std::string& text) {
  std::string lines, line;
  const auto end_line = [&] {
    if (!line.empty()) lines += guarded(line) + "\n";
    line.clear();
  };
  std::string word;
  for (const char c : roff(text, true) + "\n") {
    if (c != ' ' && c != '\n') {
      word += c;
      continue;
    }
    if (!line.empty() && line.size() + 1 + word.size() > kWidth) end_line();
    if (!word.empty()) line += (line.empty() ? "" : " ") + word;
    if (word.ends_with('.')) end_line();
    word.clear();
  }
  end_line();
  return lines;
}

/// Paragraphs that a blank line parts.
std::string paragraphs(const std::string& text) {
  std::string all;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find("\n\n", begin), text.size());
    all += (begin == 0 ? "" : ".PP\n") + filled(text.substr(begin, end - begin));
    begin = end + 2;
  }
  return all;
}

std::string examples(const std::string& text) {
  if (text.empty()) return "";
  std::string all = ".SH EXAMPLES\n.nf\n", line;
  for (const char c : text + "\n") {
    if (c != '\n') {
      line += c;
      continue;
    }
    all += line.empty() ? "\\&\n" : guarded(roff(line, false)) + "\n";
    line.clear();
  }
  return all + ".fi\n";
}

std::string header(const std::string& name, const std::string& summary, const Reference& reference,
                   const std::string& date) {
  std::string title;
  for (const char c : name) title += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  std::string version = reference.version;
  std::string what = summary;
  what[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(what[0])));
  return fmt::format(
      ".\\\" Made from the definitions that read the command line.\n"
      ".TH {} 1 {} \"{}\" \"Rehearse\"\n.SH NAME\n{} \\- {}\n",
      title, date, version, roff(name, false), roff(what, false));
}

std::string item(const ReferenceOption& option) {
  const bool argument = option.name == option.value;
  std::string head = argument ? fmt::format("\\fI{}\\fR", roff(option.name, false))
                              : fmt::format("\\fB{}\\fR", roff(option.name, false));
  if (!argument && !option.value.empty()) head += fmt::format(" \\fI{}\\fR", roff(option.value, false));
  return fmt::format(".TP\n{}\n{}", head, filled(option.help + "."));
}

std::string items(const std::string& title, const std::vector<ReferenceOption>& options) {
  std::string text;
  for (const ReferenceOption& option : options) text += item(option);
  return text.empty() ? "" : ".SH " + title + "\n" + text;
}

}  // namespace

std::string man_page(const Reference& reference, const std::string& date) {
  const std::size_t line = reference.about.find(".\n");
  std::string text = header("rehearse", reference.about.substr(0, line), reference, date);
  text += ".SH SYNOPSIS\n.B rehearse\n.I COMMAND\n[\\fIARGUMENTS\\fR]\n.SH DESCRIPTION\n" + paragraphs(reference.about);
  text += ".SH COMMANDS\n";
  for (const ReferenceCommand& command : reference.commands)
    text += fmt::format(".TP\n.BR rehearse\\-{} (1)\n{}", command.name, filled(command.summary + "."));
  return text + items("OPTIONS", reference.options) + examples(reference.examples) + kEnd + kEnvironment;
}

std::string man_page(const Reference& reference, const ReferenceCommand& command, const std::string& date) {
  std::string text = header("rehearse-" + command.name, command.summary, reference, date);
  text += fmt::format(".SH SYNOPSIS\n.B rehearse\n{}\n", roff(synopsis(command), false));
  text += ".SH DESCRIPTION\n" + filled(command.summary + ".");
  text += items("ARGUMENTS", command.arguments) + items("OPTIONS", command.options) + examples(command.examples);
  return text + kEnd + ".SH \"SEE ALSO\"\n.BR rehearse (1)\n";
}

}  // namespace rehearse::apps
