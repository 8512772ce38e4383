#include "render/film/poster.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <opencv2/imgcodecs.hpp>

#include "core/error.hpp"
#include "core/files.hpp"
#include "render/film/painter.hpp"
#include "render/workers/workers.hpp"

namespace touchdown::render {
namespace {

/// Middle of the first time in the air that one can see, or of the recording.
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

void picture(const std::vector<VideoSource>& sources, const VideoOptions& options, bool strip,
             bool labels, double time, const std::filesystem::path& path) {
  require_drawable(sources, options);
  require_writable(path);
  const FrameLayout layout{.width = options.width,
                           .height = options.height,
                           .supersampling = 2,
                           .strip = strip,
                           .labels = labels};
  if (std::isnan(time)) time = first_flight(sources.front().recording, options.labels);
  const auto bytes = static_cast<std::size_t>(options.width * options.height * 3);
  const auto prepare = [&]() -> PaintFrame {
    auto painter = std::make_shared<FramePainter>(sources, layout, options.labels);
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

void render_poster(const std::vector<VideoSource>& sources, const VideoOptions& options,
                   double time, const std::filesystem::path& path) {
  picture(sources, options, true, true, time, path);
}

void render_scene(const models::RobotModel& robot, const recordings::Recording& recording,
                  const VideoOptions& options, double time, const std::filesystem::path& path) {
  const std::vector<BeliefTrack> none;
  picture({{robot, recording, none}}, options, false, false, time, path);
}

}  // namespace touchdown::render
