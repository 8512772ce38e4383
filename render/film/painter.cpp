#include "render/film/painter.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "render/film/pose.hpp"

namespace touchdown::render {
namespace {

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

struct FramePainter::Show {
  explicit Show(const VideoSource& source)
      : recording(source.recording), poses(source.robot, source.recording), view(source.robot) {
    const bool simulated = recording.truth.size() >= recording.steps();
    const Eigen::Vector3d above(0.0, 0.0, simulated ? 0.0 : 0.5);
    std::vector<Eigen::Vector3d> base;
    for (std::size_t row = 0; row < poses.count(); ++row) {
      base.push_back(poses.base_position(row) + above);
    }
    camera = smoothed(std::move(base), recording.period(), camera_time_constant);
  }

  const recordings::Recording& recording;
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
