#pragma once

#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "render/film/plots.hpp"
#include "render/film/request.hpp"

namespace touchdown::render {

/// The plots of the strip: all of them for one run, P(contact) and knee torques for two runs, and
/// P(contact) alone for more. Without beliefs, true contact is behind the torques of one run.
std::vector<StripRow> strip_rows(const std::vector<VideoSource>& sources,
                                 const scoring::LabelConfig& labels);

/// Moving plots below the view: four seconds with the present at their third quarter and the future
/// faded. Title and legend are above each plot. Every curve is in a legend once: a long legend has
/// several lines, and names are smaller if need be.
class SignalStrip {
 public:
  /// A strip of `width`·`height` pixels.
  SignalStrip(std::vector<StripRow> rows, int width, int height);

  /// Draws the strip at `time` (s) into `image`, which must have width·height pixels (8UC3).
  void draw(cv::Mat image, double time);

 private:
  /// A name of a legend: its curve, its left edge and its line, 0 beside the title.
  struct Name {
    const StripCurve* curve;
    int x, line;
  };
  std::vector<Name> names_of(std::size_t i) const;
  bool is_in_legend_before(std::size_t i, const StripCurve& curve) const;
  bool place_rows();
  int header_of(std::size_t i) const;
  void draw_ticks(std::size_t i);
  void draw_names(std::size_t i);
  void draw_legend(const StripCurve& curve, int x, int top);
  int legend_width(const StripCurve& curve) const;

  std::vector<StripRow> rows_;
  int width_, height_;
  int letters_;               ///< height of the text
  int names_;                 ///< height of the names in legends
  int line_ = 0;              ///< distance of a legend's lines
  int left_, right_;          ///< of the plots
  std::vector<int> headers_;  ///< height of title and legend above each plot (px)
  std::vector<PlotArea> areas_;
  TextPen pen_;
  cv::Mat background_;
  cv::Mat fog_;  ///< paper, as large as the future
  std::unique_ptr<StripPlots> plots_;
};

}  // namespace touchdown::render
