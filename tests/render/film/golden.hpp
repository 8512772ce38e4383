#pragma once

#include <filesystem>
#include <string>

#include <opencv2/core.hpp>

namespace touchdown::render {

/// The difference of two pictures of the same size, after a blur: another library version may shift
/// fonts and edges by a fraction of a pixel.
struct PictureDifference {
  double mean = 0.0;        ///< absolute difference per channel, of 255
  double worst_tile = 0.0;  ///< the same within the worst tile of 16×16 pixels
  double similarity = 1.0;  ///< structural similarity (Wang et al. 2004), mean over the picture
};
PictureDifference difference(const cv::Mat& now, const cv::Mat& then);

/// Whether two pictures show the same. A missing line does not pass.
bool same_picture(const PictureDifference& difference);

/// The picture in tests/render/golden. With TOUCHDOWN_UPDATE_GOLDEN set, `drawn` replaces it.
cv::Mat golden_picture(const std::string& name, const std::filesystem::path& drawn);

}  // namespace touchdown::render
