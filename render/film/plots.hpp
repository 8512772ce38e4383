#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/freetype.hpp>

namespace touchdown::render {

/// A colour in OpenCV's order: B, G, R.
using Colour = cv::Scalar;

constexpr double colour_part(unsigned value, int shift) {
  return static_cast<double>((value >> shift) & 0xffu);
}
/// The colour of 0xRRGGBB.
inline Colour rgb(unsigned value) {
  return {colour_part(value, 0), colour_part(value, 8), colour_part(value, 16), 255.0};
}

/// The file of DejaVu Sans. Errors: `Error` when the font is not installed.
std::string font_file();

/// Writes text in DejaVu Sans. Errors: those of `font_file`.
class TextPen {
 public:
  TextPen();

  /// Writes at the position of the text's line box of `height` pixels. Returns the text's width
  /// (px).
  int write(cv::Mat& image, const std::string& text, int left, int top, int height,
            const Colour& colour) const;
  int width(const std::string& text, int height) const;

  /// Writes white text on a filled box of `height` pixels. Returns the box's width (px).
  int chip(cv::Mat& image, const std::string& text, int left, int top, int height,
           const Colour& fill) const;

 private:
  cv::Ptr<cv::freetype::FreeType2> font_;
};

/// One line of a plot.
struct StripCurve {
  std::string label;  ///< in the legend; empty: not there
  Colour colour;
  std::vector<float> values;  ///< one per row of the recording; NaN leaves a gap
  bool emphasis = true;       ///< false: thin and without a dot
};

/// The wheels in contact as bits: 1 is the left one, 2 the right one.
inline constexpr std::uint8_t left_in_contact = 1, right_in_contact = 2, both_in_contact = 3,
                              unknown_contact = 255;

/// One plot: curves over bands of true contact.
struct StripRow {
  std::string title;
  float low = 0.0f, high = 1.0f;
  std::vector<StripCurve> curves;
  /// The wheels in true contact, or `unknown_contact`, per row of the recording; may be empty. The
  /// left wheel tints the upper half of the plot, the right one the lower half.
  std::vector<std::uint8_t> wheels_in_contact;
  double period = 1e-3;  ///< between rows (s)
};

/// Fractional bits of the coordinates in calls of OpenCV.
inline constexpr int subpixel_bits = 4;

/// Colours of the strip.
inline const Colour strip_paper = rgb(0xf7f8fa);
inline const Colour strip_ink = rgb(0x22262b);

/// The vertical extent of a row's plot (pixels from the strip's top).
struct PlotArea {
  int top, bottom;
};

/// The vertical position of a value in `area` (px). Values beyond the row's range are drawn along
/// its edge.
float plot_y(const StripRow& row, const PlotArea& area, float value);

/// The plots of a whole run as one very wide image. Tiles of it, as wide as the window, are drawn
/// on demand, at twice the size and averaged.
class StripPlots {
 public:
  /// Keeps a reference to `rows`. A window is `width` pixels wide and shows `seconds`.
  StripPlots(const std::vector<StripRow>& rows, std::vector<PlotArea> areas, int width, int height,
             double seconds);

  /// Copies the window that begins at time `from` (s) into `image` (8UC3, width·height).
  void copy_window(double from, const cv::Mat& image);

 private:
  const cv::Mat& tile(int number);
  cv::Mat drawn_tile(int number) const;

  const std::vector<StripRow>& rows_;
  std::vector<PlotArea> areas_;
  int width_, height_;
  double seconds_;
  std::map<int, cv::Mat> tiles_;  ///< by number
};

}  // namespace touchdown::render
