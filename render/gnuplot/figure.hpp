#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/gnuplot/text.hpp"

namespace touchdown::render {

/// A table of numbers (or texts) that a script plots.
struct PlotData {
  std::string name;     ///< file name, beside the script
  std::string content;  ///< columns separated by tabs, `#` begins a comment, NaN is a gap
};

/// What is said about a figure where it is shown. It stands in the figure's script, as comments,
/// and the report takes it from there.
struct FigureText {
  std::string title;
  std::string caption;  ///< what is drawn; how many runs and seeds, what counts as contact
  std::string alt;      ///< for people who cannot see it: what there is to see
};

/// Where a figure's three files are.
struct Figure {
  std::filesystem::path png, svg, pdf;
};

/// Draw one figure as `<stem>.png`, `.svg` and `.pdf`, and leave `<stem>.gp` and its data beside
/// them: `gnuplot <name>.gp` in that folder draws it again.
///
/// `commands` draw one figure on an open terminal; `width` and `height` are in pixels of the PNG's
/// 96 per inch. Everything is drawn in a scratch folder first and looked at: all files appear,
/// whole, or those stay that were there before.
/// Errors: `InputError` when a file beside the PNG bears the figure's name and is not one of ours;
/// `Error` when gnuplot is not installed or complains (with its first line), or when the folder
/// cannot be written or is full.
Figure draw_figure(const std::filesystem::path& stem, int width, int height,
                   const std::string& commands, const std::vector<PlotData>& data,
                   const FigureText& text = {});

/// Ends what `set multiplot` began.
inline constexpr const char* end_multiplot = "unset multiplot\n";

/// What the script of a figure says about it; empty where it says nothing.
FigureText figure_text(const std::string& script);

}  // namespace touchdown::render
