#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace touchdown {

/// The number of bytes of the longest valid UTF-8 prefix; all bytes if the whole text is valid.
std::size_t utf8_size(std::string_view text);

/// A text from a file or a command line for a terminal, with nothing in it that a terminal obeys:
/// control characters (C0 and C1, so no escape sequence remains), marks that change the direction
/// of text, and bytes that are not UTF-8 become `\n`, `\t`, `\x1b`, `\u009b` and so on. `kept` are
/// control characters that stay.
std::string terminal_text(std::string_view text, std::string_view kept = "");

}  // namespace touchdown
