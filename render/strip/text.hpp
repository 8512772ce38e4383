#pragma once

#include <string>

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

/// Writes text in DejaVu Sans. Errors: `Error` when the font is not installed.
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

}  // namespace touchdown::render
