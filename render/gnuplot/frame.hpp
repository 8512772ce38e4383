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

/// The frame of a figure: the title above, the caption below, and the body between them, in which
/// panels have fixed pixel positions. All lengths are in pixels of the PNG.
class FigureFrame {
 public:
  /// `body_height` is the height that the panels need. Long titles have several lines. With
  /// `letters`, a caption has this size instead of 9 pt.
  FigureFrame(const FigureFile& file, FigureText text, double width, double body_height,
              double letters = 9.0);

  int width() const;
  int height() const;

  /// Commands that open the multiplot and place title and caption, for the first panel's plot.
  std::string begin() const;
  /// Draws the figure of these panels, which follow `begin`. Files and errors as `draw_figure`.
  Figure draw(const std::string& panels, const std::vector<PlotData>& data) const;
  /// The same for panels without `begin`, with `<stem>.dat` as their data.
  Figure draw(const std::string& panels, const std::string& data) const;

  /// Commands for a panel with axes that span this box; `top` counts from the top of the body. The
  /// first panel's plot draws title and caption too.
  std::string panel(double left, double top, double panel_width, double panel_height) const;
  /// Commands for a colour bar in this box, horizontal when it is wider than high.
  std::string colour_bar(double left, double top, double bar_width, double bar_height) const;
  /// A `set key` command for a legend with its top left corner here.
  std::string key(double left, double top) const;
  /// Commands to give after every panel's plot, so that the next plot does not repeat the labels.
  static constexpr const char* end_labels = "unset label\n";
  static std::string end_panel() { return "unset label\nunset arrow\n"; }
  /// A `set label` command for a position in the body.
  std::string label(const std::string& text, double left, double top, const char* style) const;

  /// A place in the body as a share of the figure, from its left and from its lower edge.
  double x(double pixels) const { return pixels / width_; }
  double y(double pixels) const { return 1.0 - (title_height_ + pixels) / height_; }

 private:
  FigureFile file_;
  FigureText text_;
  double letters_;
  std::string title_lines_, caption_lines_;  ///< wrapped to the figure's width
  double title_height_, caption_height_;     ///< px
  double width_, height_;
};

/// Panels in rows and columns that share their time axis, at fixed pixel positions. The title is
/// above, the caption below, and every row has a legend on its right, or above it where the figure
/// is printed narrow. It builds the gnuplot commands of a figure with a width of about 1280 pixels.
class PanelGrid {
 public:
  struct Layout {
    std::vector<std::string> columns;  ///< their titles
    std::vector<double> row_heights;   ///< px
    double panel_width = 427.0;        ///< px; less where the figure is printed narrow
    double right = 0.0;                ///< width of the legends beside the panels (px)
    std::vector<std::size_t> keys;     ///< lines of each row's legend
    double narrow_right = 190.0;       ///< the same with the legends above their rows (px)
    bool is_narrow = false;            ///< printed on a width that is too small for it
    double letters = 11.0;             ///< at least (pt)
    std::optional<double> at = {};     ///< origin of the time axis (s); default: a takeoff
  };

  PanelGrid(const FigureFile& file, Layout layout, FigureText text);

  std::size_t rows() const { return layout_.row_heights.size(); }

  /// Opens the multiplot: fonts, titles and caption, and the time axis between two times (ms).
  std::string begin(double from, double to) const;
  /// Places the next plot. The last row has tics and label of the time axis, the first column those
  /// of the vertical axis. `y_label` may have two lines.
  std::string panel(std::size_t row, std::size_t column, std::string_view y_label) const;
  /// Puts the next plot's key right of the row, at this distance (px), or above the row.
  std::string key(std::size_t row, double offset = 14.0) const;
  /// Puts a colour bar of this width right of the row, at this distance (px).
  std::string colour_bar(std::size_t row, double offset, double width) const;
  /// Draws the figure of these commands. Files and errors as `draw_figure`.
  Figure draw(const std::string& commands, const std::vector<PlotData>& data) const {
    return frame_.draw(commands, data);
  }

 private:
  static Layout fitting(Layout layout, double room);
  double left(std::size_t column) const;         ///< edge of a panel (px)
  double top(std::size_t row) const;             ///< from the top of the body (px)
  std::size_t key_lines(std::size_t row) const;  ///< of two entries each, above a row
  double key_height(std::size_t row) const;      ///< px
  double beside() const { return frame_.width() - layout_.right; }  ///< right of the panels (px)

  Layout layout_;
  FigureFrame frame_;
};

}  // namespace touchdown::render
