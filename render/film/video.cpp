#include "render/film/video.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <deque>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/film/encode.hpp"
#include "render/film/painter.hpp"

namespace touchdown::render {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double duration(const VideoSource& source) {
  return source.recording.period() * static_cast<double>(source.recording.steps() - 1);
}

void picture(const std::vector<VideoSource>& sources, VideoOptions options, bool annotated,
             double time, const std::filesystem::path& path) {
  require_drawable(sources, options);
  require_writable(path);
  options.quality = VideoQuality::page;
  options.speed = 1.0;  // a still picture has no speed
  if (std::isnan(time)) time = first_flight(sources.front().recording, options.labels);
  const auto bytes = static_cast<std::size_t>(options.width * options.height * 3);
  const auto prepare = [&]() -> PaintFrame {
    auto painter = std::make_shared<FramePainter>(sources, options, annotated);
    return [&, painter](int, std::uint8_t* pixels) {
      std::memcpy(pixels, painter->paint(time).data, bytes);
    };
  };
  paint_in_order(1, bytes, 1, prepare, [&](int, const std::uint8_t* pixels) {
    write_picture({options.height, options.width, CV_8UC3, const_cast<std::uint8_t*>(pixels)},
                  path);
  });
}

/// The number of frames of a film, `step` seconds of the recordings apart.
int frames_of(const std::vector<VideoSource>& sources, const Film& film, double step) {
  std::vector<VideoSource> shown;
  double end = 0.0;
  for (const std::size_t run : film.runs) {
    shown.push_back(sources[run]);
  }
  require_drawable(shown, film.options);
  for (const VideoSource& source : shown) end = std::max(end, duration(source));
  const double from = film.options.from;
  end = std::min(end, film.options.to);
  if (!(from >= 0.0) || !(from <= end)) {
    throw InputError(fmt::format("a video from {} s to {} s: the recording has {:.3f} s", from,
                                 film.options.to, end));
  }
  return 1 + static_cast<int>(std::floor((end - from) / step + 1e-9));
}

/// A film's files, and its part of the memory that the workers share: a frame for the encoder and,
/// if one frame becomes a still, the same as a picture. The parent converts nothing, because
/// threads of OpenCV would not survive its next fork.
class FilmFile {
 public:
  /// `place`: of its part in the shared memory (bytes); `step` between frames (s).
  FilmFile(const Film& film, int frames, double step, std::size_t place)
      : film_(film), frames_(frames), place_(place) {
    if (!film.still) return;
    require_writable(film.still->path);
    const double wanted = std::round((film.still->time - film.options.from) / step);
    still_frame_ = static_cast<int>(std::clamp(wanted, 0.0, frames - 1.0));
  }

  int frames() const { return frames_; }
  std::size_t bytes() const { return encoded_bytes() + (film_.still ? 2 * encoded_bytes() : 0); }

  void open() { writer_.emplace(film_.path, film_.options); }

  void store(int frame, const cv::Mat& bgr, std::uint8_t* shared) const {
    const VideoOptions& format = film_.options;
    cv::Mat i420(format.height * 3 / 2, format.width, CV_8UC1, shared + place_);
    cv::cvtColor(bgr, i420, cv::COLOR_BGR2YUV_I420);
    if (frame == still_frame_) std::memcpy(shared + picture_place(), bgr.data, 2 * encoded_bytes());
  }

  void encode(int frame, const std::uint8_t* shared) {
    writer_->write(shared + place_);
    if (frame != still_frame_) return;
    const std::uint8_t* const picture = shared + picture_place();
    still_.assign(picture, picture + 2 * encoded_bytes());
  }

  void finish() {
    writer_->finish();
    if (!film_.still) return;
    write_picture({film_.options.height, film_.options.width, CV_8UC3, still_.data()},
                  film_.still->path);
  }

 private:
  std::size_t encoded_bytes() const {
    return static_cast<std::size_t>(film_.options.width * film_.options.height * 3 / 2);
  }
  std::size_t picture_place() const { return place_ + encoded_bytes(); }

  const Film& film_;
  int frames_;
  std::size_t place_;
  int still_frame_ = -1;
  std::optional<VideoWriter> writer_;
  std::vector<std::uint8_t> still_;
};

}  // namespace

double first_flight(const logs::Recording& recording, const scoring::LabelConfig& labels) {
  for (const scoring::Flight& flight : visible_flights(recording, labels)) {
    if (flight.takeoff == 0 || flight.landing == recording.steps()) continue;
    return recording.period() * static_cast<double>(flight.takeoff + flight.landing) / 2.0;
  }
  return recording.period() * static_cast<double>(recording.steps()) / 2.0;
}

VideoStatistics render_video(const std::vector<VideoSource>& sources, const VideoOptions& options,
                             const std::filesystem::path& path) {
  std::vector<std::size_t> all(sources.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return render_films(sources, {{.runs = std::move(all), .options = options, .path = path}});
}

VideoStatistics render_films(const std::vector<VideoSource>& sources,
                             const std::vector<Film>& films) {
  const Clock::time_point start = Clock::now();
  const VideoOptions& shared = films.front().options;
  const double step = shared.speed / shared.fps;
  std::deque<FilmFile> files;  // a writer cannot move
  std::size_t bytes = 0;
  VideoStatistics statistics;
  for (const Film& film : films) {
    files.emplace_back(film, frames_of(sources, film, step), step, bytes);
    bytes += files.back().bytes();
    statistics.frames = std::max(statistics.frames, files.back().frames());
  }
  const auto prepare = [&]() -> PaintFrame {
    auto painter = std::make_shared<FramePainter>(sources, films);
    return [&, painter](int frame, std::uint8_t* pixels) {
      std::vector<bool> wanted;
      for (const FilmFile& file : files) wanted.push_back(frame < file.frames());
      const auto pictures = painter->paint(shared.from + frame * step, wanted);
      for (std::size_t i = 0; i < files.size(); ++i) {
        if (wanted[i]) files[i].store(frame, pictures[i], pixels);
      }
    };
  };
  const auto consume = [&](int frame, const std::uint8_t* pixels) {
    if (frame == 0) statistics.first_frame_seconds = seconds_since(start);
    const Clock::time_point before = Clock::now();
    for (FilmFile& file : files) {
      if (frame < file.frames()) file.encode(frame, pixels);
    }
    statistics.encoding_seconds += seconds_since(before);
    if (shared.progress) shared.progress(frame + 1, statistics.frames);
  };
  paint_in_order(statistics.frames, bytes, shared.workers, prepare, consume, [&] {
    for (FilmFile& file : files) file.open();
  });
  const Clock::time_point before = Clock::now();
  for (FilmFile& file : files) file.finish();
  statistics.encoding_seconds += seconds_since(before);
  statistics.seconds = seconds_since(start);
  return statistics;
}

void render_poster(const std::vector<VideoSource>& sources, const VideoOptions& options,
                   double time, const std::filesystem::path& path) {
  picture(sources, options, true, time, path);
}

void render_scene(const models::RobotModel& robot, const logs::Recording& recording,
                  const VideoOptions& options, double time, const std::filesystem::path& path) {
  const std::vector<BeliefTrack> none;
  picture({{robot, recording, none}}, options, false, time, path);
}

}  // namespace touchdown::render
