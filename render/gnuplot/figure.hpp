#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/figures/figure_spec.hpp"

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

/// Where a figure is drawn, and at which size.
struct FigureFile {
  // NOLINTNEXTLINE(google-explicit-constructor): most figures are for screens
  FigureFile(std::filesystem::path path, experiments::PrintConfig config = {},
             std::function<void(const std::string&)> before = {})
      : stem(std::move(path)), print(std::move(config)), before_writing(std::move(before)) {}

  std::string name() const { return stem.filename().string(); }
  /// The width in which panels should fit (px of a figure on a screen): there, text of 10 pt is
  /// 6 pt high in print.
  double room() const;

  std::filesystem::path stem;  ///< of its files, without extension
  experiments::PrintConfig print;
  std::function<void(const std::string& name)> before_writing;  ///< called for each file, if set
};

/// Columns of panels (px).
struct PanelColumns {
  std::size_t count;
  double width, gap;
  double left(std::size_t column) const { return static_cast<double>(column) * (width + gap); }
};
/// As many of `wanted` as fit in the figure beside margins. Panels become narrower before their
/// number decreases.
PanelColumns columns_in(double room, double margins, const PanelColumns& wanted,
                        double least_width = 190.0);

/// The paths of a figure's three files.
struct Figure {
  std::filesystem::path png, svg, pdf;
};

/// Draws one figure as `<stem>.png`, `.svg` and `.pdf`, and writes `<stem>.gp` and its data beside
/// them. `gnuplot <name>.gp` in that folder draws the figure again.
///
/// `commands` draw one figure on an open terminal. `width` and `height` are in pixels of the PNG on
/// a screen, 96 per inch. A printed figure is scaled to its width, with a PNG of 300 pixels per
/// inch, and smaller text is enlarged to 6 pt. The files are drawn and checked in a scratch folder
/// first: either all files appear, whole, or the previous ones stay. Errors: `InputError` when
/// another file beside the PNG has the figure's name and was not written by this program; `Error`
/// when gnuplot is not installed or reports an error (with its first line), or when the folder
/// cannot be written or is full.
Figure draw_figure(const FigureFile& file, int width, int height, const std::string& commands,
                   const std::vector<PlotData>& data, const FigureText& text = {});

/// Ends a `set multiplot`.
inline constexpr const char* end_multiplot = "unset multiplot\n";

/// The texts in a figure's script; those that the script lacks are empty.
FigureText figure_text(const std::string& script);

/// `text` as a gnuplot string constant. No character of it acts as markup, as a substitution or as
/// the string's end.
std::string gnuplot_text(std::string_view text);

/// `file_argument` as a gnuplot string constant.
std::string gnuplot_file(const std::string& name);

/// The width of the widest of these texts, in letters of 10 pt (px).
double text_width(const std::vector<std::string>& texts);

/// The line width of a curve by its place in the order of drawing: later curves are thinner, so
/// that they do not cover earlier ones where both coincide.
std::string curve_width(std::size_t place, std::size_t count);

/// The tics of a vertical axis that names rows: the first name on top, the last one at 0.
std::string row_tics(const std::vector<std::string>& names);

/// A number for a data file, with all digits; NaN is written as gnuplot reads it.
std::string number(double value);

}  // namespace touchdown::render
