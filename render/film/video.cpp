#include "render/film/video.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "render/encode/writer.hpp"
#include "render/film/painter.hpp"
#include "render/workers/workers.hpp"

namespace touchdown::render {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double duration(const VideoSource& source) {
  return source.recording.period() * static_cast<double>(source.recording.steps() - 1);
}

}  // namespace

VideoStatistics render_video(const std::vector<VideoSource>& sources, const VideoOptions& options,
                             const std::filesystem::path& path) {
  const Clock::time_point start = Clock::now();
  require_drawable(sources, options);
  double end = 0.0;
  for (const VideoSource& source : sources) end = std::max(end, duration(source));
  end = std::min(end, options.to);
  if (!(options.from >= 0.0) || !(options.from <= end)) {
    throw InputError(fmt::format("a video from {} s to {} s: the recording has {:.3f} s",
                                 options.from, options.to, end));
  }
  const double step = options.speed / options.fps;
  const int frames = 1 + static_cast<int>(std::floor((end - options.from) / step + 1e-9));
  const FrameLayout layout{.width = options.width,
                           .height = options.height,
                           .supersampling = options.quality == VideoQuality::page ? 2 : 1,
                           .speed = options.speed};

  VideoWriter writer(path, {.width = options.width,
                            .height = options.height,
                            .fps = options.fps,
                            .crf = options.crf,
                            .encoder = options.encoder});
  VideoStatistics statistics{.frames = frames};
  const auto bytes = static_cast<std::size_t>(options.width * options.height * 3 / 2);
  const auto prepare = [&]() -> PaintFrame {
    auto painter = std::make_shared<FramePainter>(sources, layout, options.labels);
    return [&, painter](int frame, std::uint8_t* pixels) {
      cv::Mat i420(options.height * 3 / 2, options.width, CV_8UC1, pixels);
      cv::cvtColor(painter->paint(options.from + frame * step), i420, cv::COLOR_BGR2YUV_I420);
    };
  };
  const auto consume = [&](int frame, const std::uint8_t* pixels) {
    if (frame == 0) statistics.first_frame_seconds = seconds_since(start);
    const Clock::time_point before = Clock::now();
    writer.write(pixels);
    statistics.encoding_seconds += seconds_since(before);
    if (options.progress) options.progress(frame + 1, frames);
  };
  paint_in_order(frames, bytes, options.workers, prepare, consume);
  const Clock::time_point before = Clock::now();
  writer.finish();
  statistics.encoding_seconds += seconds_since(before);
  statistics.seconds = seconds_since(start);
  return statistics;
}

}  // namespace touchdown::render
