#pragma once

#include <filesystem>
#include <string>

#include <opencv2/core.hpp>

namespace touchdown::render {

/// How far two pictures of the same size are apart, after a blur: another version of a font or of
/// an edge may move by a fraction of a pixel.
struct PictureDifference {
  double mean = 0.0;        ///< absolute difference per channel, of 255
  double worst_tile = 0.0;  ///< the same within the worst tile of 16×16 pixels
  double similarity = 1.0;  ///< structural similarity (Wang et al. 2004), mean over the picture
};
PictureDifference difference(const cv::Mat& now, const cv::Mat& then);

/// Whether they show the same. A line that is missing does not pass.
bool same_picture(const PictureDifference& difference);

/// The picture kept in tests/render/golden. With TOUCHDOWN_UPDATE_GOLDEN set, `drawn` becomes it.
cv::Mat golden_picture(const std::string& name, const std::filesystem::path& drawn);

}  // namespace touchdown::render
