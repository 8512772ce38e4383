#include "core/terminal_text.hpp"

#include <fmt/format.h>

namespace touchdown {

namespace {

/// Bytes of the first UTF-8 character of the text; 0 if it is invalid (RFC 3629).
std::size_t character_size(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const auto follow = [&](std::size_t count) {
    for (std::size_t i = 1; i <= count; ++i) {
      if ((byte(i) & 0xc0U) != 0x80U) return std::size_t{0};
    }
    return count + 1;
  };
  const unsigned first = byte(0);
  if (first < 0x80U) return 1;
  if (first >= 0xc2U && first <= 0xdfU) return follow(1);
  if (first == 0xe0U && byte(1) < 0xa0U) return 0;   // overlong encoding
  if (first == 0xedU && byte(1) >= 0xa0U) return 0;  // UTF-16 surrogate
  if (first >= 0xe0U && first <= 0xefU) return follow(2);
  if (first == 0xf0U && byte(1) < 0x90U) return 0;
  if (first == 0xf4U && byte(1) >= 0x90U) return 0;  // beyond Unicode
  return first >= 0xf0U && first <= 0xf4U ? follow(3) : 0;
}

/// Control characters of one byte, as a programmer would write them.
std::string escaped(unsigned char byte) {
  switch (byte) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default:
      return fmt::format("\\x{:02x}", byte);
  }
}

/// The code point of a valid sequence of two or three bytes; 0 for others.
unsigned code_point(std::string_view text) {
  const auto bits = [&](std::size_t i, unsigned mask) {
    return static_cast<unsigned>(static_cast<unsigned char>(text[i])) & mask;
  };
  if (text.size() == 2) return bits(0, 0x1fU) << 6U | bits(1, 0x3fU);
  if (text.size() == 3) return bits(0, 0x0fU) << 12U | bits(1, 0x3fU) << 6U | bits(2, 0x3fU);
  return 0;
}

/// C1 controls, line and paragraph separators, and marks of direction.
bool is_obeyed(unsigned point) {
  return (point >= 0x80 && point < 0xa0) || (point >= 0x200e && point <= 0x200f) ||
         (point >= 0x2028 && point <= 0x202e) || (point >= 0x2066 && point <= 0x2069);
}

}  // namespace

std::size_t utf8_size(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t size = character_size(text.substr(at));
    if (size == 0) break;
    at += size;
  }
  return at;
}

std::string terminal_text(std::string_view text, std::string_view kept) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = static_cast<unsigned char>(text[at]);
    const std::string_view sequence = text.substr(at, character_size(text.substr(at)));
    if (sequence.empty()) {
      result += fmt::format("\\x{:02x}", byte);
      ++at;
      continue;
    }
    if (byte < 0x80) {
      const bool is_control = byte < 0x20 || byte == 0x7f;
      const bool stays = !is_control || kept.find(text[at]) != std::string_view::npos;
      if (stays) {
        result.push_back(text[at]);
      } else {
        result += escaped(byte);
      }
      ++at;
      continue;
    }
    const unsigned point = code_point(sequence);
    if (is_obeyed(point)) {
      result += fmt::format("\\u{:04x}", point);
    } else {
      result += sequence;
    }
    at += sequence.size();
  }
  return result;
}

}  // namespace touchdown
