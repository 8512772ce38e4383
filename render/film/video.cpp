#include "render/film/video.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <optional>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "core/files.hpp"
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

/// The middle of the first visible flight, or else of the recording (s).
double first_flight(const recordings::Recording& recording, const scoring::LabelConfig& labels) {
  scoring::LabelConfig visible = labels;
  visible.debounce = std::max(visible.debounce, 0.04);
  const std::vector<std::uint8_t> contact = wheels_in_contact(recording, visible);
  std::size_t begin = 0;
  for (std::size_t k = 1; k < contact.size(); ++k) {
    if (contact[k] == 0 && contact[k - 1] != 0) begin = k;
    if (begin > 0 && contact[k] != 0 && contact[k - 1] == 0) {
      return recording.period() * static_cast<double>(begin + k) / 2.0;
    }
  }
  return recording.period() * static_cast<double>(recording.steps()) / 2.0;
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
    const cv::Mat bgr(options.height, options.width, CV_8UC3, const_cast<std::uint8_t*>(pixels));
    const std::string kind = path.extension() == ".jpg" ? ".jpg" : ".png";
    std::vector<std::uint8_t> file;
    if (!cv::imencode(kind, bgr, file, {cv::IMWRITE_JPEG_QUALITY, 82})) {
      throw Error("cannot compress a picture");
    }
    write_atomically(path,
                     std::string_view(reinterpret_cast<const char*>(file.data()), file.size()));
  });
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
  std::optional<VideoWriter> writer;
  VideoStatistics statistics{.frames = frames};
  const auto bytes = static_cast<std::size_t>(options.width * options.height * 3 / 2);
  const auto prepare = [&]() -> PaintFrame {
    auto painter = std::make_shared<FramePainter>(sources, options);
    return [&, painter](int frame, std::uint8_t* pixels) {
      cv::Mat i420(options.height * 3 / 2, options.width, CV_8UC1, pixels);
      cv::cvtColor(painter->paint(options.from + frame * step), i420, cv::COLOR_BGR2YUV_I420);
    };
  };
  const auto consume = [&](int frame, const std::uint8_t* pixels) {
    if (frame == 0) statistics.first_frame_seconds = seconds_since(start);
    const Clock::time_point before = Clock::now();
    writer->write(pixels);
    statistics.encoding_seconds += seconds_since(before);
    if (options.progress) options.progress(frame + 1, frames);
  };
  paint_in_order(frames, bytes, options.workers, prepare, consume,
                 [&] { writer.emplace(path, options); });
  const Clock::time_point before = Clock::now();
  writer->finish();
  statistics.encoding_seconds += seconds_since(before);
  statistics.seconds = seconds_since(start);
  return statistics;
}

void render_poster(const std::vector<VideoSource>& sources, const VideoOptions& options,
                   double time, const std::filesystem::path& path) {
  picture(sources, options, true, time, path);
}

void render_scene(const models::RobotModel& robot, const recordings::Recording& recording,
                  const VideoOptions& options, double time, const std::filesystem::path& path) {
  const std::vector<BeliefTrack> none;
  picture({{robot, recording, none}}, options, false, time, path);
}

}  // namespace touchdown::render
