#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include <yaml-cpp/yaml.h>

namespace touchdown {

/// The number of bytes of the longest valid UTF-8 prefix; all bytes if the whole text is valid.
std::size_t utf8_size(std::string_view text);

/// Whether a text is a whole number with a leading zero, which some parsers read as octal.
bool has_leading_zero(std::string_view number);

/// Checks a YAML text before it becomes a node tree. The tree of a valid text has no cycles and a
/// limited size. Errors: `InputError`, which begins with the result of `place` for the mark, for
/// - bytes that are not UTF-8, and a second document;
/// - an alias inside the value that it refers to;
/// - more than 64 levels or a million values, aliases expanded;
/// - a key that is not a name;
/// - a number with a leading zero, such as 010, which some parsers read as octal and others as
///   decimal. In quotes it is a text.
/// Malformed YAML throws yaml-cpp's `ParserException`.
void check_yaml_text(const std::string& text,
                     const std::function<std::string(const YAML::Mark&)>& place);

}  // namespace touchdown
