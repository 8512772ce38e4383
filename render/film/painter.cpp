#include "render/film/painter.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace touchdown::render {

namespace {

struct Label {
  const char* text;
  unsigned colour;
};
/// By `Outcome`, and by the wheels in flight: 1 is the left one, 2 the right one.
constexpr Label outcome_labels[] = {{"FINISHED", 0x2f6f4f},
                                    {"TIME IS OVER", 0x5c636e},
                                    {"FELL", 0xb0304f},
                                    {"DIVERGED", 0xb0304f},
                                    {"LEFT THE TERRAIN", 0xb0304f}};
constexpr Label flight_labels[] = {{"ON THE GROUND", 0x2f6f4f},
                                   {"LEFT WHEEL IN THE AIR", 0x8a6d1d},
                                   {"RIGHT WHEEL IN THE AIR", 0x8a6d1d},
                                   {"IN THE AIR", 0xd9760f}};

Label state_label(const logs::Recording& recording, std::size_t row,
                  const std::vector<WheelFlight>& flights) {
  const bool last = row + 1 >= recording.steps();
  if (last && recording.info.outcome) {
    return outcome_labels[static_cast<std::size_t>(*recording.info.outcome)];
  }
  if (recording.truth.size() < recording.steps()) return {"NO GROUND TRUTH", 0x5c636e};
  const double time = recording.period() * static_cast<double>(row);
  std::size_t in_flight = 0;
  for (const WheelFlight& flight : flights) {
    if (time >= flight.takeoff && time < flight.landing) in_flight |= flight.wheel + 1;
  }
  return flight_labels[in_flight];
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

constexpr double camera_time_constant = 0.35;  // s

}  // namespace

std::size_t row_at(const logs::Recording& recording, double time) {
  const double k = std::round(time / recording.period());
  return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(recording.steps() - 1)));
}

struct FramePainter::Show {
  Show(const VideoSource& shown, const scoring::LabelConfig& labels)
      : source(shown),
        flights(wheel_flights(shown.recording, labels)),
        poses(shown.robot, shown.recording) {
    std::vector<Eigen::Vector3d> base;
    for (std::size_t row = 0; row < poses.count(); ++row) {
      base.push_back(poses.base_position(row));
    }
    camera = smoothed(std::move(base), shown.recording.period(), camera_time_constant);
  }

  VideoSource source;
  std::vector<WheelFlight> flights;
  Poses poses;
  std::vector<Eigen::Vector3d> camera;
  std::optional<SceneView> view = {};  ///< made in the OpenGL context
};

FramePainter::FramePainter(const std::vector<VideoSource>& sources, const VideoOptions& options,
                           bool annotated)
    : options_(options), strip_height_(annotated ? strip_height_of(options) : 0) {
  for (const VideoSource& source : sources) {
    shows_.push_back(std::make_unique<Show>(source, options.labels));
  }
  // Views of quality `page` are painted larger, and reduced.
  const double factor = options.quality == VideoQuality::page ? page_oversampling : 1.0;
  const cv::Size view = view_size();
  gl_.emplace(static_cast<int>(std::ceil(factor * view.width)),
              static_cast<int>(std::ceil(factor * view.height)));
  for (const auto& show : shows_) show->view.emplace(show->source.robot);
  picture_ = cv::Mat(options.height, options.width, CV_8UC3, strip_paper);
  if (!annotated) return;
  strip_ = std::make_unique<SignalStrip>(strip_rows(sources, options.labels), options.width,
                                         strip_height_);
}

FramePainter::~FramePainter() = default;

cv::Size FramePainter::view_size() const {
  const ViewGrid grid = grid_of(shows_.size());
  return {options_.width / grid.columns, (options_.height - strip_height_) / grid.rows};
}

cv::Rect FramePainter::pane(std::size_t i) const {
  const cv::Size size = view_size();
  const int columns = grid_of(shows_.size()).columns;
  const int number = static_cast<int>(i);
  return {cv::Point(number % columns * size.width, number / columns * size.height), size};
}

void FramePainter::paint_view(std::size_t i, double time) {
  Show& show = *shows_[i];
  const std::size_t row = row_at(show.source.recording, time);
  show.poses.apply(row, show.view->data());
  show.view->draw({0, 0, gl_->width(), gl_->height()}, show.camera[row]);
  gl_->finish();
  const cv::Mat view(gl_->height(), gl_->width(), CV_8UC4, gl_->pixels());
  cv::Mat there = picture_(pane(i));
  if (view.size() == there.size()) {
    cv::cvtColor(view, there, cv::COLOR_BGRA2BGR);
    return;
  }
  cv::resize(view, reduced_, there.size(), 0, 0, cv::INTER_AREA);
  cv::cvtColor(reduced_, there, cv::COLOR_BGRA2BGR);
}

const cv::Mat& FramePainter::paint(double time) {
  for (std::size_t i = 0; i < shows_.size(); ++i) paint_view(i, time);
  if (!strip_) return picture_;
  const int bottom = options_.height - strip_height_;
  for (std::size_t i = 0; i < shows_.size(); ++i) write_labels(i, time);
  const Colour paper = rgb(0xf7f8fa);
  const ViewGrid grid = grid_of(shows_.size());
  const int half = options_.width / 2;
  if (grid.columns > 1) cv::line(picture_, {half, 0}, {half, bottom - 1}, paper, 2);
  if (grid.rows > 1) {
    cv::line(picture_, {0, bottom / 2}, {options_.width - 1, bottom / 2}, paper, 2);
  }
  strip_->draw(picture_.rowRange(bottom, options_.height), time);
  return picture_;
}

void FramePainter::write_labels(std::size_t i, double time) {
  const Show& show = *shows_[i];
  const logs::Recording& recording = show.source.recording;
  const int height = std::max(16, options_.height * (shows_.size() > 2 ? 22 : 30) / 720);
  const int gap = height / 3;
  const int top = pane(i).y + height / 2;
  int x = pane(i).x + height / 2;
  x += gap + pen_.chip(picture_, label_of(show.source), x, top, height, rgb(0x2b2f36));
  x += gap + pen_.chip(picture_, fmt::format("t = {:.2f} s", time), x, top, height, rgb(0x5c636e));
  const Label state = state_label(recording, row_at(recording, time), show.flights);
  x += gap + pen_.chip(picture_, state.text, x, top, height, rgb(state.colour));
  if (options_.speed != 1.0) {
    pen_.chip(picture_, fmt::format("{:.3g}× speed", options_.speed), x, top, height,
              rgb(0x2b2f36));
  }
}

}  // namespace touchdown::render
