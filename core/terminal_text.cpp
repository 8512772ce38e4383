#include "core/terminal_text.hpp"

#include <boost/locale/utf.hpp>
#include <optional>

#include <fmt/format.h>

namespace touchdown {

namespace {

namespace utf = boost::locale::utf;

/// The first character of the text, which is removed from it; nothing if it is no UTF-8.
std::optional<utf::code_point> take_character(std::string_view& text) {
  const char* end = text.data();
  const utf::code_point point = utf::utf_traits<char>::decode(end, text.data() + text.size());
  if (point == utf::illegal || point == utf::incomplete) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return point;
}

/// Control characters as a programmer would write them.
std::string escaped(utf::code_point point) {
  switch (point) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default:
      return point < 0x80 ? fmt::format("\\x{:02x}", point) : fmt::format("\\u{:04x}", point);
  }
}

/// Controls (C0, C1), line and paragraph separators, and marks of direction.
bool is_obeyed(utf::code_point point) {
  return point < 0x20 || (point >= 0x7f && point < 0xa0) || (point >= 0x200e && point <= 0x200f) ||
         (point >= 0x2028 && point <= 0x202e) || (point >= 0x2066 && point <= 0x2069);
}

}  // namespace

std::size_t utf8_size(std::string_view text) {
  std::string_view rest = text;
  while (take_character(rest)) {
  }
  return text.size() - rest.size();
}

std::string terminal_text(std::string_view text, std::string_view kept) {
  std::string result;
  while (!text.empty()) {
    const std::string_view before = text;
    const std::optional<utf::code_point> point = take_character(text);
    if (!point) {
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(before.front()));
      text.remove_prefix(1);
    } else if (!is_obeyed(*point) || kept.find(before.front()) != std::string_view::npos) {
      result += before.substr(0, before.size() - text.size());
    } else {
      result += escaped(*point);
    }
  }
  return result;
}

}  // namespace touchdown
