#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/gnuplot/text.hpp"

namespace touchdown::render {

/// A table of numbers or texts that a script plots.
struct PlotData {
  std::string name;     ///< file name, beside the script
  std::string content;  ///< columns separated by tabs, `#` begins a comment, NaN is a gap
};

/// The texts that accompany a figure. The figure's script contains them as comments, and the report
/// reads them from there.
struct FigureText {
  std::string title;
  std::string caption;  ///< what is drawn, the numbers of runs and seeds, what counts as contact
  std::string alt;      ///< a description for readers who cannot see the figure
};

/// The paths of a figure's three files.
struct Figure {
  std::filesystem::path png, svg, pdf;
};

/// Draws one figure as `<stem>.png`, `.svg` and `.pdf`, and writes `<stem>.gp` and its data beside
/// them. `gnuplot <name>.gp` in that folder draws the figure again.
///
/// `commands` draw one figure on an open terminal. `width` and `height` are in pixels of the PNG,
/// 96 per inch. The files are drawn and checked in a scratch folder first: either all files appear,
/// whole, or the previous ones stay.
/// Errors: `InputError` when another file beside the PNG has the figure's name and was not written
/// by this program; `Error` when gnuplot is not installed or reports an error (with its first
/// line), or when the folder cannot be written or is full.
Figure draw_figure(const std::filesystem::path& stem, int width, int height,
                   const std::string& commands, const std::vector<PlotData>& data,
                   const FigureText& text = {});

/// Ends a `set multiplot`.
inline constexpr const char* end_multiplot = "unset multiplot\n";

/// The texts in a figure's script; those that the script lacks are empty.
FigureText figure_text(const std::string& script);

}  // namespace touchdown::render
