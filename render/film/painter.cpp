#include "render/film/painter.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "render/film/pose.hpp"
#include "render/film/strip_rows.hpp"

namespace touchdown::render {
namespace {

constexpr double camera_time_constant = 0.35;  // s
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
ViewGrid grid_of(int runs) { return {std::min(runs, 2), (runs + 1) / 2}; }

/// The factor by which the view is drawn larger than it is shown.
int supersampling(const VideoOptions& options) {
  return options.quality == VideoQuality::page ? 2 : 1;
}

}  // namespace

struct FramePainter::Show {
  Show(const VideoSource& the_source, const scoring::LabelConfig& labels)
      : source(the_source), poses(the_source.robot, the_source.recording), view(the_source.robot) {
    const bool simulated = source.recording.truth.size() >= source.recording.steps();
    const Eigen::Vector3d above(0.0, 0.0, simulated ? 0.0 : 0.5);
    std::vector<Eigen::Vector3d> base;
    for (std::size_t row = 0; row < poses.count(); ++row) {
      base.push_back(poses.base_position(row) + above);
    }
    camera = smoothed(std::move(base), source.recording.period(), camera_time_constant);
    scoring::LabelConfig readable = labels;
    readable.debounce = std::max(readable.debounce, label_debounce);
    contact = wheels_in_contact(source.recording, readable);
  }

  std::size_t row(double time) const {
    const double k = std::round(time / source.recording.period());
    return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(poses.count() - 1)));
  }

  VideoSource source;
  Poses poses;
  SceneView view;
  std::vector<Eigen::Vector3d> camera;
  std::vector<std::uint8_t> contact;
};

FramePainter::FramePainter(const std::vector<VideoSource>& sources, const VideoOptions& options,
                           bool annotated)
    : options_(options),
      strip_height_(annotated ? options.height * (options.width < 1000 ? 300 : 220) / 720 / 2 * 2
                              : 0),
      gl_(options.width * supersampling(options),
          (options.height - strip_height_) * supersampling(options)) {
  for (const VideoSource& source : sources) {
    shows_.push_back(std::make_unique<Show>(source, options.labels));
  }
  if (annotated) {
    strip_ = std::make_unique<SignalStrip>(strip_rows(sources, options.labels), options.width,
                                           strip_height_);
  }
  picture_.create(options.height, options.width, CV_8UC3);
}

FramePainter::~FramePainter() = default;

const cv::Mat& FramePainter::paint(double time) {
  const int count = static_cast<int>(shows_.size());
  const ViewGrid grid = grid_of(count);
  const int wide = gl_.width() / grid.columns;
  const int high = gl_.height() / grid.rows;
  for (int i = 0; i < count; ++i) {
    Show& show = *shows_[static_cast<std::size_t>(i)];
    const std::size_t row = show.row(time);
    show.poses.apply(row, show.view.data());
    const int from_below = grid.rows - 1 - i / grid.columns;  // OpenGL counts from below
    show.view.draw({i % grid.columns * wide, from_below * high, wide, high}, show.camera[row]);
  }
  gl_.finish();
  const cv::Mat drawn(gl_.height(), gl_.width(), CV_8UC4, gl_.pixels());
  cv::Mat view = picture_.rowRange(0, options_.height - strip_height_);
  if (supersampling(options_) == 1) {
    cv::cvtColor(drawn, view, cv::COLOR_BGRA2BGR);
  } else {
    cv::resize(drawn, averaged_, view.size(), 0, 0, cv::INTER_AREA);
    cv::cvtColor(averaged_, view, cv::COLOR_BGRA2BGR);
  }
  if (strip_) {
    for (int i = 0; i < count; ++i) {
      const Show& show = *shows_[static_cast<std::size_t>(i)];
      paint_labels(show, show.row(time), time, i % grid.columns * view.cols / grid.columns,
                   i / grid.columns * view.rows / grid.rows);
    }
    const Colour paper = rgb(0xf7f8fa);
    if (grid.columns > 1) {
      cv::line(view, {view.cols / 2, 0}, {view.cols / 2, view.rows - 1}, paper, 2);
    }
    if (grid.rows > 1) {
      cv::line(view, {0, view.rows / 2}, {view.cols - 1, view.rows / 2}, paper, 2);
    }
    strip_->draw(picture_.rowRange(options_.height - strip_height_, options_.height), time);
  }
  return picture_;
}

void FramePainter::paint_labels(const Show& show, std::size_t row, double time, int left,
                                int view_top) {
  const int height = std::max(16, options_.height * (shows_.size() > 2 ? 22 : 30) / 720);
  const int gap = height / 3;
  const int top = view_top + height / 2;
  int x = left + height / 2;
  x += gap + pen_.chip(picture_, label_of(show.source), x, top, height, rgb(0x2b2f36));
  x += gap + pen_.chip(picture_, fmt::format("t = {:.2f} s", time), x, top, height, rgb(0x5c636e));
  const Label state = state_label(show.source.recording, row, show.contact);
  x += gap + pen_.chip(picture_, state.text, x, top, height, rgb(state.colour));
  if (options_.speed != 1.0) {
    pen_.chip(picture_, fmt::format("{:.3g}× speed", options_.speed), x, top, height,
              rgb(0x2b2f36));
  }
}

}  // namespace touchdown::render
