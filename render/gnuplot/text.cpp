#include "render/gnuplot/text.hpp"

#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "core/table.hpp"

namespace touchdown::render {

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
    const std::size_t letters = width(word);
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

}  // namespace touchdown::render
