#include "render/gnuplot_text.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

namespace touchdown {

std::string gnuplot_text(std::string_view text) {
  std::string result = "'";
  for (const char letter : text) {
    if (letter == '\n') {
      result += "'.\"\\n\".'";
    } else if (letter == '\'') {
      result += "'.\"'\".'";  // gnuplot's own '' fails at the beginning of a text
    } else if (letter == '@') {
      result += "'.\"\\100\".'";  // a macro's sign, even within quotes
    } else if (static_cast<unsigned char>(letter) >= 0x20) {
      result += letter;
    }
  }
  return result + "'";
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "NaN"; }

std::string wrapped(std::string_view text, std::size_t columns) {
  std::string result;
  std::size_t used = 0;
  std::istringstream words{std::string(text)};
  for (std::string word; words >> word;) {
    // Letters, not bytes, count: UTF-8 continuation bytes begin with 10.
    const auto letters =
        static_cast<std::size_t>(std::count_if(word.begin(), word.end(), [](char c) {
          return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
        }));
    if (used > 0 && used + 1 + letters > columns) {
      result += '\n';
      used = 0;
    } else if (used > 0) {
      result += ' ';
      ++used;
    }
    result += word;
    used += letters;
  }
  return result;
}

}  // namespace touchdown
