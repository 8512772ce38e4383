#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// The distance between ticks that gives an axis of length `span` at most `most` of them: 1, 2 or 5
/// times a power of ten.
double tick_step(double span, double most);

/// Panels in rows and columns that share their time axis, at fixed pixel positions. The title is
/// above, the caption below, and every row has a legend on its right. It builds the gnuplot
/// commands of a figure with a width of about 1280 pixels; its texts stay legible in a paper's
/// column.
class PanelGrid {
 public:
  struct Layout {
    std::vector<std::string> columns = {""};  ///< their titles; empty for none
    std::vector<double> row_heights;          ///< px
    double panel_width = 452.0;               ///< px
    double right = 250.0;                     ///< width of the legends beside the panels (px)
    std::optional<double> at = {};            ///< origin of the time axis (s); default: a takeoff
  };

  PanelGrid(Layout layout, FigureText text);

  std::size_t rows() const { return layout_.row_heights.size(); }

  /// Opens the multiplot: fonts, titles and caption, and the time axis between two times (ms).
  std::string begin(double from, double to) const;
  /// Places the next plot. The last row has tics and label of the time axis, the first column those
  /// of the vertical axis. `y_label` may have two lines.
  std::string panel(std::size_t row, std::size_t column, std::string_view y_label) const;
  /// Puts the next plot's key right of the row, at this distance (px).
  std::string key(std::size_t row, double offset = 14.0) const;
  /// Puts a colour bar of this width right of the row, at this distance (px).
  std::string colour_bar(std::size_t row, double offset, double width) const;
  /// Draws the figure of these commands. Files and errors as `draw_figure`.
  Figure draw(const std::filesystem::path& stem, const std::string& commands,
              const std::vector<PlotData>& data) const;

 private:
  int width() const;
  int height() const;
  double x(std::size_t column) const;  ///< left edge (px)
  double y(std::size_t row) const;     ///< upper edge, from above (px)
  double screen_x(double pixels) const;
  double screen_y(double pixels_from_above) const;

  Layout layout_;
  FigureText text_;
  std::string caption_lines_;  ///< the caption, wrapped to the figure's width
  double caption_height_;
};

}  // namespace touchdown::render
