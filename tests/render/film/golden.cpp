#include "tests/render/film/golden.hpp"

#include <algorithm>
#include <cstdlib>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace touchdown::render {
namespace {

double mean_of_channels(const cv::Mat& picture) {
  const cv::Scalar mean = cv::mean(picture);
  return std::max({mean[0], mean[1], mean[2]});
}

cv::Mat smooth(const cv::Mat& picture) {
  cv::Mat result;
  cv::GaussianBlur(picture, result, {11, 11}, 1.5);
  return result;
}

double structural_similarity(const cv::Mat& first, const cv::Mat& second) {
  constexpr double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
  cv::Mat a, b;
  first.convertTo(a, CV_64F);
  second.convertTo(b, CV_64F);
  const cv::Mat mean_a = smooth(a), mean_b = smooth(b);
  const cv::Mat means = mean_a.mul(mean_b);
  const cv::Mat squares = mean_a.mul(mean_a) + mean_b.mul(mean_b);
  const cv::Mat covariance = smooth(a.mul(b)) - means;
  const cv::Mat variances = smooth(a.mul(a) + b.mul(b)) - squares;
  const cv::Mat above = (2.0 * means + c1).mul(2.0 * covariance + c2);
  const cv::Mat below = (squares + c1).mul(variances + c2);
  return cv::mean(above / below)[0];
}

}  // namespace

PictureDifference difference(const cv::Mat& now, const cv::Mat& then) {
  if (now.size() != then.size() || now.empty()) return {255.0, 255.0, 0.0};
  cv::Mat a, b, apart, grey_now, grey_then;
  cv::GaussianBlur(now, a, {5, 5}, 0);
  cv::GaussianBlur(then, b, {5, 5}, 0);
  cv::absdiff(a, b, apart);
  PictureDifference result{mean_of_channels(apart), 0.0, 1.0};
  constexpr int side = 16;
  for (int y = 0; y < apart.rows; y += side) {
    for (int x = 0; x < apart.cols; x += side) {
      const cv::Rect tile(x, y, std::min(side, apart.cols - x), std::min(side, apart.rows - y));
      result.worst_tile = std::max(result.worst_tile, mean_of_channels(apart(tile)));
    }
  }
  cv::cvtColor(now, grey_now, cv::COLOR_BGR2GRAY);
  cv::cvtColor(then, grey_then, cv::COLOR_BGR2GRAY);
  result.similarity = structural_similarity(grey_now, grey_then);
  return result;
}

bool same_picture(const PictureDifference& difference) {
  return difference.mean < 2.0 && difference.worst_tile < 24.0 && difference.similarity > 0.96;
}

cv::Mat golden_picture(const std::string& name, const std::filesystem::path& drawn) {
  const std::filesystem::path golden =
      std::filesystem::path(TOUCHDOWN_SOURCE_DIR) / "tests/render/golden" / name;
  if (std::getenv("TOUCHDOWN_UPDATE_GOLDEN") != nullptr) {
    std::filesystem::copy_file(drawn, golden, std::filesystem::copy_options::overwrite_existing);
  }
  return cv::imread(golden.string());
}

}  // namespace touchdown::render
