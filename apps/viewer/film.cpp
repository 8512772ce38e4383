#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <opencv2/core/utils/logger.hpp>

#include "apps/viewer/log_window.hpp"
#include "core/error.hpp"
#include "core/files.hpp"

namespace touchdown::viewer {

Film::Film(const std::filesystem::path& path) {
  const std::string name = path.string();
  if (!is_there(path)) throw InputError(fmt::format("--film: there is no file '{}'", name));
  // Their own messages would stand beside ours.
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // NOLINT(concurrency-mt-unsafe): before threads
  bool is_film = capture_.open(name, cv::CAP_FFMPEG);
  if (is_film) {
    rate_ = capture_.get(cv::CAP_PROP_FPS);
    count_ = std::lround(capture_.get(cv::CAP_PROP_FRAME_COUNT));
    is_film = rate_ > 0.0 && rate_ < 1e5 && count_ > 0 && !frame(0).empty();
  }
  if (!is_film) {
    throw InputError(fmt::format("--film: '{}': expected a film, such as an .mp4 of H.264", name));
  }
  size_ = picture_.size();
}

const cv::Mat& Film::at(double time) {
  constexpr double rounding = 1e-6;
  const double number = std::floor(time * rate_ + rounding);
  if (!(number >= 0.0 && number < static_cast<double>(count_))) return none_;
  return frame(static_cast<long>(number));
}

const cv::Mat& Film::frame(long number) {
  if (number == decoded_) return picture_;
  constexpr long soon = 60;  // pictures: a seek decodes about as many, from a key frame on
  const bool is_ahead = number > decoded_ && number - decoded_ <= soon;
  if (!is_ahead) {
    capture_.set(cv::CAP_PROP_POS_FRAMES, static_cast<double>(number));
  } else {
    for (long k = decoded_ + 1; k < number; ++k) {
      if (!capture_.grab()) break;
    }
  }
  // A film that is shorter than its header states keeps its last picture.
  cv::Mat next;
  if (capture_.read(next) && !next.empty()) cv::swap(picture_, next);
  decoded_ = number;
  return picture_;
}

}  // namespace touchdown::viewer
