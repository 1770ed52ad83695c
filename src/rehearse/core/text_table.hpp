#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rehearse {

/// Characters of UTF-8.
std::size_t characters(const std::string& text);
std::string first_characters(const std::string& text, std::size_t most);

/// Bytes of the character that begins at text[at]; 0: none does.
std::size_t character_at(std::string_view text, std::size_t at);

/// A line a row, columns below one another with two spaces between. A row may have fewer cells than others.
std::vector<std::string> aligned(const std::vector<std::vector<std::string>>& rows);

}  // namespace rehearse
