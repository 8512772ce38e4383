#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace touchdown {

/// A table of numbers (or texts) that a script plots.
struct PlotData {
  std::string name;     ///< file name, beside the script
  std::string content;  ///< columns separated by tabs, `#` begins a comment, NaN is a gap
};

/// Where a figure's three files are.
struct Figure {
  std::filesystem::path png, svg, pdf;
};

/// Draw one figure as `<stem>.png`, `.svg` and `.pdf`, and leave `<stem>.gp`, its data and the
/// style file `style.gp` beside them: `gnuplot <name>.gp` in that folder draws it again.
///
/// `commands` draw one figure on an open terminal; `width` and `height` are in pixels of the PNG's
/// 96 per inch. Everything is drawn in a scratch folder first: all files appear, or none.
/// Errors: `Error` when gnuplot is not installed or complains (with its first line), or when the
/// folder cannot be written.
Figure draw_figure(const std::filesystem::path& stem, int width, int height,
                   const std::string& commands, const std::vector<PlotData>& data);

/// `text` as a gnuplot string constant: nothing in it is markup, substitution or the string's end.
std::string gnuplot_text(std::string_view text);

/// A number for a data file: all digits, NaN as gnuplot reads it.
std::string number(double value);

/// `text` broken into lines of at most `columns` characters.
std::string wrapped(std::string_view text, std::size_t columns);

}  // namespace touchdown
