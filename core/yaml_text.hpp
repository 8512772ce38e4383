#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include <yaml-cpp/yaml.h>

namespace touchdown {

/// How many bytes at the beginning of a text are UTF-8; all of them in a text that is.
std::size_t utf8_size(std::string_view text);

/// Whether a text is a whole number with a leading zero, which is octal to some readers.
bool has_leading_zero(std::string_view number);

/// Looks through a YAML text before anything is made of it, so that whoever walks over its nodes
/// meets neither a circle nor more of them than memory and patience hold. Errors: `InputError` that
/// `place`, called with a mark, begins, for
/// - bytes that are not UTF-8, and a second document;
/// - an alias inside of what it stands for; more than 64 levels, or a million values, with what
///   aliases stand for;
/// - a key that is no name;
/// - a number with a leading zero, such as 010, which is octal to some readers and decimal to
///   others. Between quotes it is a text.
/// What is no YAML at all is yaml-cpp's `ParserException`.
void check_yaml_text(const std::string& text,
                     const std::function<std::string(const YAML::Mark&)>& place);

}  // namespace touchdown
