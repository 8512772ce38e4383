#pragma once

#include <filesystem>
#include <string>

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

namespace touchdown::viewer {

/// A person's film of a log, picture by picture.
class Film {
 public:
  /// Errors: `InputError` for a file that is no film.
  explicit Film(const std::filesystem::path& path);

  double frame_period() const { return 1.0 / rate_; }  ///< s
  cv::Size size() const { return size_; }

  /// The picture that is shown at a time of the film (s), valid until the next call; an empty one
  /// before its start and after its end. Pictures that follow the last one soon are decoded on the
  /// way, others are sought.
  const cv::Mat& at(double time);

 private:
  const cv::Mat& frame(long number);

  std::string name_;
  cv::VideoCapture capture_;
  double rate_ = 0.0;  ///< pictures per second
  cv::Size size_;
  long count_ = 0;
  long decoded_ = -1;  ///< the number of `picture_`
  cv::Mat picture_, none_;
};

}  // namespace touchdown::viewer
