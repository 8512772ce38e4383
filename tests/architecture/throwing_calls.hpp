#pragma once

#include <string>
#include <vector>

namespace touchdown::tests {

/// One line for every call of std::filesystem in the text of a source file that throws its
/// `filesystem_error`: without a `std::error_code` as the last argument, or a step of an iterator
/// over a folder in a range-based `for`. `file` is for the lines: "core/files.cpp:42: rename".
std::vector<std::string> throwing_calls(const std::string& file, const std::string& text);

}  // namespace touchdown::tests
