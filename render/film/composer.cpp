#include "render/film/composer.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "render/film/strip_rows.hpp"

namespace touchdown::render {
namespace {

/// Shorter states of contact get no label, because it could not be read (s).
constexpr double label_debounce = 0.05;

struct Label {
  const char* text;
  unsigned colour;
};
/// By `Outcome`, and by the number of wheels in contact.
constexpr Label outcome_labels[] = {{"FINISHED", 0x2f6f4f},
                                    {"TIME IS OVER", 0x5c636e},
                                    {"FELL", 0xb0304f},
                                    {"DIVERGED", 0xb0304f},
                                    {"LEFT THE TERRAIN", 0xb0304f}};
constexpr Label contact_labels[] = {
    {"IN THE AIR", 0xd9760f}, {"ON ONE WHEEL", 0x8a6d1d}, {"ON THE GROUND", 0x2f6f4f}};

Label state_label(const recordings::Recording& recording, std::size_t row,
                  const std::vector<std::uint8_t>& contact) {
  const bool last = row + 1 >= recording.steps();
  if (last && recording.info.outcome) {
    return outcome_labels[static_cast<std::size_t>(*recording.info.outcome)];
  }
  if (contact.empty()) return {"NO GROUND TRUTH", 0x5c636e};
  return contact_labels[contact[row]];
}

/// The layout of the runs: up to two side by side, more in rows of two.
struct ViewGrid {
  int columns, rows;
};
ViewGrid grid_of(std::size_t runs) {
  const int count = static_cast<int>(runs);
  return {std::min(count, 2), (count + 1) / 2};
}

int strip_height_of(const VideoOptions& options) {
  return options.height * (options.width < 1000 ? 300 : 220) / 720 / 2 * 2;
}

}  // namespace

cv::Size single_view_size(const VideoOptions& options) {
  return {options.width, options.height - strip_height_of(options)};
}

std::size_t row_at(const recordings::Recording& recording, double time) {
  const double k = std::round(time / recording.period());
  return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(recording.steps() - 1)));
}

FrameComposer::FrameComposer(const std::vector<VideoSource>& sources, const VideoOptions& options,
                             bool annotated)
    : options_(options), strip_height_(annotated ? strip_height_of(options) : 0) {
  scoring::LabelConfig readable = options.labels;
  readable.debounce = std::max(readable.debounce, label_debounce);
  for (const VideoSource& source : sources) {
    runs_.push_back({source, wheels_in_contact(source.recording, readable)});
  }
  picture_ = cv::Mat(options.height, options.width, CV_8UC3, strip_paper);
  if (!annotated) return;
  strip_ = std::make_unique<SignalStrip>(strip_rows(sources, options.labels), options.width,
                                         strip_height_);
}

cv::Size FrameComposer::view_size() const {
  const ViewGrid grid = grid_of(runs_.size());
  return {options_.width / grid.columns, (options_.height - strip_height_) / grid.rows};
}

cv::Rect FrameComposer::pane(std::size_t i) const {
  const cv::Size size = view_size();
  const int columns = grid_of(runs_.size()).columns;
  const int number = static_cast<int>(i);
  return {cv::Point(number % columns * size.width, number / columns * size.height), size};
}

void FrameComposer::place(std::size_t i, const cv::Mat& view) {
  cv::Mat there = picture_(pane(i));
  if (view.size() == there.size()) {
    cv::cvtColor(view, there, cv::COLOR_BGRA2BGR);
    return;
  }
  const int width = std::min(
      view.cols,
      static_cast<int>(std::lround(static_cast<double>(view.rows) * there.cols / there.rows)));
  const cv::Rect middle((view.cols - width) / 2, 0, width, view.rows);
  cv::resize(view(middle), reduced_, there.size(), 0, 0, cv::INTER_AREA);
  cv::cvtColor(reduced_, there, cv::COLOR_BGRA2BGR);
}

const cv::Mat& FrameComposer::picture(double time) {
  if (!strip_) return picture_;
  const int bottom = options_.height - strip_height_;
  for (std::size_t i = 0; i < runs_.size(); ++i) write_labels(i, time);
  const Colour paper = rgb(0xf7f8fa);
  const ViewGrid grid = grid_of(runs_.size());
  const int half = options_.width / 2;
  if (grid.columns > 1) cv::line(picture_, {half, 0}, {half, bottom - 1}, paper, 2);
  if (grid.rows > 1) {
    cv::line(picture_, {0, bottom / 2}, {options_.width - 1, bottom / 2}, paper, 2);
  }
  strip_->draw(picture_.rowRange(bottom, options_.height), time);
  return picture_;
}

void FrameComposer::write_labels(std::size_t i, double time) {
  const Run& run = runs_[i];
  const int height = std::max(16, options_.height * (runs_.size() > 2 ? 22 : 30) / 720);
  const int gap = height / 3;
  const int top = pane(i).y + height / 2;
  int x = pane(i).x + height / 2;
  x += gap + pen_.chip(picture_, label_of(run.source), x, top, height, rgb(0x2b2f36));
  x += gap + pen_.chip(picture_, fmt::format("t = {:.2f} s", time), x, top, height, rgb(0x5c636e));
  const Label state =
      state_label(run.source.recording, row_at(run.source.recording, time), run.contact);
  x += gap + pen_.chip(picture_, state.text, x, top, height, rgb(state.colour));
  if (options_.speed != 1.0) {
    pen_.chip(picture_, fmt::format("{:.3g}× speed", options_.speed), x, top, height,
              rgb(0x2b2f36));
  }
}

}  // namespace touchdown::render
