#pragma once

#include <filesystem>
#include <string>

#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

/// The outside of a figure: its title above, its caption below, and panels at fixed pixels between
/// them. All lengths are pixels of the PNG.
class FigureFrame {
 public:
  /// `body_height` is what the panels need.
  FigureFrame(const std::string& title, const std::string& caption, double width,
              double body_height);

  int width() const;
  int height() const;

  /// The figure of these panels, `described` for people who cannot see it. Files as `draw_figure`;
  /// the data is `<stem>.dat`. Errors: as `draw_figure`.
  Figure draw(const std::filesystem::path& stem, const std::string& panels, const std::string& data,
              const std::string& described) const;

  /// A panel whose axes span this box, its top measured from the body's; title and caption are
  /// drawn with the first one.
  std::string panel(double left, double top, double panel_width, double panel_height) const;
  /// A colour bar in this box: horizontal when it is wider than high.
  std::string colour_bar(double left, double top, double bar_width, double bar_height) const;
  /// To be said after every panel's plot: labels are not drawn again.
  static std::string end_panel() { return "unset label\nunset arrow\n"; }
  /// A `set label` at a place of the body.
  std::string label(const std::string& text, double left, double top, const char* style) const;

 private:
  double x(double pixels) const { return pixels / width_; }
  double y(double pixels) const;

  std::string title_, caption_;
  std::string caption_lines_;  ///< the caption, broken to the figure's width
  double width_, height_;
};

}  // namespace touchdown::render
