#include "render/film/painter.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

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

Label state_label(const logs::Recording& recording, std::size_t row,
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

constexpr double camera_time_constant = 0.35;  // s

std::vector<FrameComposer> composers_of(const std::vector<VideoSource>& sources,
                                        const std::vector<Film>& films, bool annotated) {
  std::vector<FrameComposer> composers;
  for (const Film& film : films) {
    std::vector<VideoSource> shown;
    for (const std::size_t run : film.runs) shown.push_back(sources[run]);
    composers.emplace_back(shown, film.options, annotated);
  }
  return composers;
}

/// The smallest size from which every film can take its views: none has more rows or, for its rows,
/// more columns. Films of quality `page` reduce larger views.
cv::Size common_view(const std::vector<Film>& films, const std::vector<FrameComposer>& composers) {
  std::vector<cv::Size> sizes;
  int height = 1;
  for (std::size_t i = 0; i < films.size(); ++i) {
    const double factor = films[i].options.quality == VideoQuality::page ? page_oversampling : 1.0;
    const cv::Size shown = composers[i].view_size();
    sizes.push_back({static_cast<int>(std::ceil(factor * shown.width)),
                     static_cast<int>(std::ceil(factor * shown.height))});
    if (films[i].least_view) sizes.push_back(*films[i].least_view);
  }
  for (const cv::Size& size : sizes) height = std::max(height, size.height);
  int width = 1;
  for (const cv::Size& size : sizes) {
    width = std::max(width, (size.width * height + size.height - 1) / size.height);
  }
  return {width, height};
}

Film film_of_all(const std::vector<VideoSource>& sources, const VideoOptions& options) {
  Film film{.runs = std::vector<std::size_t>(sources.size()), .options = options};
  std::iota(film.runs.begin(), film.runs.end(), std::size_t{0});
  return film;
}

}  // namespace

cv::Size single_view_size(const VideoOptions& options) {
  return {options.width, options.height - strip_height_of(options)};
}

std::size_t row_at(const logs::Recording& recording, double time) {
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

struct FramePainter::Show {
  explicit Show(const VideoSource& source)
      : recording(source.recording), poses(source.robot, source.recording), view(source.robot) {
    std::vector<Eigen::Vector3d> base;
    for (std::size_t row = 0; row < poses.count(); ++row) {
      base.push_back(poses.base_position(row));
    }
    camera = smoothed(std::move(base), recording.period(), camera_time_constant);
  }

  const logs::Recording& recording;
  Poses poses;
  SceneView view;
  std::vector<Eigen::Vector3d> camera;
};

FramePainter::FramePainter(const std::vector<VideoSource>& sources, const std::vector<Film>& films,
                           bool annotated)
    : films_(films),
      composers_(composers_of(sources, films, annotated)),
      gl_(common_view(films_, composers_).width, common_view(films_, composers_).height) {
  for (const VideoSource& source : sources) shows_.push_back(std::make_unique<Show>(source));
}

FramePainter::FramePainter(const std::vector<VideoSource>& sources, const VideoOptions& options,
                           bool annotated)
    : FramePainter(sources, {film_of_all(sources, options)}, annotated) {}

FramePainter::~FramePainter() = default;

cv::Mat FramePainter::paint(double time) {
  return paint(time, std::vector<bool>(films_.size(), true)).front();
}

std::vector<cv::Mat> FramePainter::paint(double time, const std::vector<bool>& wanted) {
  for (std::size_t i = 0; i < shows_.size(); ++i) {
    cv::Mat drawn;
    for (std::size_t f = 0; f < films_.size(); ++f) {
      const std::vector<std::size_t>& runs = films_[f].runs;
      for (std::size_t place = 0; wanted[f] && place < runs.size(); ++place) {
        if (runs[place] != i) continue;
        if (drawn.empty()) drawn = view(i, time);
        composers_[f].place(place, drawn);
      }
    }
  }
  std::vector<cv::Mat> pictures(films_.size());
  for (std::size_t f = 0; f < films_.size(); ++f) {
    if (wanted[f]) pictures[f] = composers_[f].picture(time);
  }
  return pictures;
}

cv::Mat FramePainter::view(std::size_t run, double time) {
  Show& show = *shows_[run];
  const std::size_t row = row_at(show.recording, time);
  show.poses.apply(row, show.view.data());
  show.view.draw({0, 0, gl_.width(), gl_.height()}, show.camera[row]);
  gl_.finish();
  return {gl_.height(), gl_.width(), CV_8UC4, gl_.pixels()};
}

}  // namespace touchdown::render
