#include "render/video.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/frame_painter.hpp"
#include "render/frame_workers.hpp"
#include "render/video_writer.hpp"

namespace touchdown {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void check(const std::vector<VideoSource>& sources, const VideoOptions& options) {
  if (options.width < 160 || options.height < 120 || options.width > 7680 ||
      options.height > 4320 || options.width % 2 != 0 || options.height % 2 != 0) {
    throw InputError(fmt::format("a video of {}x{}: expected even numbers, 160x120 to 7680x4320",
                                 options.width, options.height));
  }
  if (options.fps < 1 || options.fps > 1000) {
    throw InputError(fmt::format("{} frames per second: expected 1 to 1000", options.fps));
  }
  if (!(options.speed > 0.0) || !std::isfinite(options.speed)) {
    throw InputError(fmt::format("speed {}: expected a number above 0", options.speed));
  }
  for (const VideoSource& source : sources) {
    if (source.recording.steps() == 0) {
      throw InputError("the recording is empty: there is nothing to draw");
    }
    for (const BeliefTrack& belief : source.beliefs) {
      for (const auto* wheels : {&belief.p_contact, &belief.p_takeoff, &belief.p_landing}) {
        for (const std::vector<float>& values : *wheels) {
          if (values.empty() || values.size() == source.recording.steps()) continue;
          throw InputError(fmt::format("estimator '{}' has {} values for {} rows of the recording",
                                       belief.name, values.size(), source.recording.steps()));
        }
      }
    }
  }
}

double duration(const VideoSource& source) {
  return source.recording.period() * static_cast<double>(source.recording.steps() - 1);
}

VideoStatistics film(const std::vector<VideoSource>& sources, const VideoOptions& options,
                     const std::filesystem::path& path) {
  const Clock::time_point start = Clock::now();
  check(sources, options);
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

  VideoWriter writer(path, options.width, options.height, options.fps);
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

/// Middle of the first time in the air that one can see, or of the recording.
double first_flight(const Recording& recording, const LabelConfig& labels) {
  LabelConfig visible = labels;
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

void picture(const VideoSource& source, const VideoOptions& options, bool strip, bool labels,
             double time, const std::filesystem::path& path) {
  check({source}, options);
  require_writable(path);
  const FrameLayout layout{.width = options.width,
                           .height = options.height,
                           .supersampling = 2,
                           .strip = strip,
                           .labels = labels};
  if (std::isnan(time)) time = first_flight(source.recording, options.labels);
  const auto bytes = static_cast<std::size_t>(options.width * options.height * 3);
  const auto prepare = [&]() -> PaintFrame {
    auto painter =
        std::make_shared<FramePainter>(std::vector<VideoSource>{source}, layout, options.labels);
    return [&, painter](int, std::uint8_t* pixels) {
      std::memcpy(pixels, painter->paint(time).data, bytes);
    };
  };
  paint_in_order(1, bytes, 1, prepare, [&](int, const std::uint8_t* pixels) {
    const cv::Mat bgr(options.height, options.width, CV_8UC3, const_cast<std::uint8_t*>(pixels));
    std::vector<std::uint8_t> png;
    if (!cv::imencode(".png", bgr, png)) throw Error("cannot compress a PNG");
    write_atomically(path, std::string_view(reinterpret_cast<const char*>(png.data()), png.size()));
  });
}

}  // namespace

VideoStatistics render_video(const RobotModel& robot, const Recording& recording,
                             const std::vector<BeliefTrack>& beliefs, const VideoOptions& options,
                             const std::filesystem::path& path) {
  return film({{robot, recording, beliefs}}, options, path);
}

VideoStatistics render_side_by_side(const VideoSource& left, const VideoSource& right,
                                    const VideoOptions& options,
                                    const std::filesystem::path& path) {
  return film({left, right}, options, path);
}

void render_poster(const RobotModel& robot, const Recording& recording,
                   const std::vector<BeliefTrack>& beliefs, const VideoOptions& options,
                   double time, const std::filesystem::path& path) {
  picture({robot, recording, beliefs}, options, true, true, time, path);
}

void render_scene(const RobotModel& robot, const Recording& recording, const VideoOptions& options,
                  double time, const std::filesystem::path& path) {
  const std::vector<BeliefTrack> none;
  picture({robot, recording, none}, options, false, false, time, path);
}

}  // namespace touchdown
