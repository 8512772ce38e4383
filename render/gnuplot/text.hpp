#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace touchdown::render {

/// `text` as a gnuplot string constant: nothing in it is markup, substitution or the string's end.
std::string gnuplot_text(std::string_view text);

/// A number for a data file: all digits, NaN as gnuplot reads it.
std::string number(double value);

/// `text` broken into lines of at most `columns` characters.
std::string wrapped(std::string_view text, std::size_t columns);

}  // namespace touchdown::render
