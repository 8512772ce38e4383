#pragma once

#include <filesystem>
#include <string>

#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// The frame of a figure: the title above, the caption below, and the body between them, in which
/// panels have fixed pixel positions. All lengths are in pixels of the PNG.
class FigureFrame {
 public:
  /// `body_height` is the height that the panels need.
  FigureFrame(const std::string& title, const std::string& caption, double width,
              double body_height);

  int width() const;
  int height() const;

  /// Draws the figure of these panels. `described` is its alternative text. Files as `draw_figure`;
  /// the data is `<stem>.dat`. Errors: as `draw_figure`.
  Figure draw(const std::filesystem::path& stem, const std::string& panels, const std::string& data,
              const std::string& described) const;

  /// Commands for a panel with axes that span this box; `top` counts from the top of the body. The
  /// first panel's plot draws title and caption too.
  std::string panel(double left, double top, double panel_width, double panel_height) const;
  /// Commands for a colour bar in this box, horizontal when it is wider than high.
  std::string colour_bar(double left, double top, double bar_width, double bar_height) const;
  /// A `set key` command for a legend with its top left corner here.
  std::string key(double left, double top) const;
  /// Commands to give after every panel's plot, so that the next plot does not repeat the labels.
  static std::string end_panel() { return "unset label\nunset arrow\n"; }
  /// A `set label` command for a position in the body.
  std::string label(const std::string& text, double left, double top, const char* style) const;

 private:
  double x(double pixels) const { return pixels / width_; }
  double y(double pixels) const;

  std::string title_, caption_;
  std::string caption_lines_;  ///< the caption, wrapped to the figure's width
  double width_, height_;
};

}  // namespace touchdown::render
