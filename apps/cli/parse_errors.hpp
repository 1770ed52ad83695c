#pragma once

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace rehearse::apps {

/// The options that are given twice, or the unknown flags, a line each with the most similar one; else the message of
/// CLI11.
std::string why_not_parsed(const CLI::App& app, const CLI::ParseError& error);

}  // namespace rehearse::apps
