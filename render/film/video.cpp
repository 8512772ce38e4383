#include "render/film/video.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <optional>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/film/encode.hpp"
#include "render/film/painter.hpp"

namespace touchdown::render {
namespace {

using Clock = std::chrono::steady_clock;

double duration(const VideoSource& source) {
  return source.recording.period() * static_cast<double>(source.recording.steps() - 1);
}

/// Returns when the longest recording ends. Errors: `InputError` for a time beyond it.
double end_of(const std::vector<VideoSource>& sources, const char* what, double time) {
  double end = 0.0;
  for (const VideoSource& source : sources) end = std::max(end, duration(source));
  if (time >= 0.0 && time <= end) return end;
  throw InputError(
      fmt::format("a {} from {} s on: expected a time from 0 to {:.3f} s, where "
                  "the recording ends",
                  what, time, end));
}

void picture(const std::vector<VideoSource>& sources, VideoOptions options, bool annotated,
             double time, const std::filesystem::path& path) {
  require_drawable(sources, options);
  require_writable(path);
  options.quality = VideoQuality::page;
  options.speed = 1.0;  // a still picture has no speed
  if (std::isnan(time)) time = first_flight(sources.front().recording, options.labels);
  (void)end_of(sources, "picture", time);
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
int frames_of(const std::vector<VideoSource>& sources, const VideoOptions& options, double step) {
  require_drawable(sources, options);
  if (!(options.to >= options.from)) {
    throw InputError(fmt::format("a film from {} s to {} s: it ends before it begins", options.from,
                                 options.to));
  }
  const double end = std::min(end_of(sources, "film", options.from), options.to);
  return 1 + static_cast<int>(std::floor((end - options.from) / step + 1e-9));
}

}  // namespace

double first_flight(const logs::Recording& recording, const scoring::LabelConfig& labels) {
  for (const WheelFlight& flight : wheel_flights(recording, labels)) {
    if (flight.is_whole) return 0.5 * (flight.takeoff + flight.landing);
  }
  return recording.period() * static_cast<double>(recording.steps()) / 2.0;
}

VideoStatistics render_video(const std::vector<VideoSource>& sources, const VideoOptions& options,
                             const std::filesystem::path& path) {
  const Clock::time_point start = Clock::now();
  const double step = options.speed / options.fps;
  VideoStatistics statistics{.frames = frames_of(sources, options, step)};
  std::optional<VideoWriter> writer;
  // Workers convert the pictures: threads of OpenCV in this process would not survive its fork.
  const auto prepare = [&]() -> PaintFrame {
    auto painter = std::make_shared<FramePainter>(sources, options);
    return [&, painter](int frame, std::uint8_t* pixels) {
      cv::Mat i420(options.height * 3 / 2, options.width, CV_8UC1, pixels);
      cv::cvtColor(painter->paint(options.from + frame * step), i420, cv::COLOR_BGR2YUV_I420);
    };
  };
  const auto consume = [&](int frame, const std::uint8_t* pixels) {
    writer->write(pixels);
    if (options.progress) options.progress(frame + 1, statistics.frames);
  };
  const auto bytes = static_cast<std::size_t>(options.width * options.height * 3 / 2);
  paint_in_order(statistics.frames, bytes, options.workers, prepare, consume,
                 [&] { writer.emplace(path, options); });
  writer->finish();
  statistics.seconds = std::chrono::duration<double>(Clock::now() - start).count();
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
