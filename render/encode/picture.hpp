#pragma once

#include <filesystem>

#include <opencv2/core/mat.hpp>

namespace touchdown::render {

/// Writes a picture (8UC3, BGR) as a PNG, or as a JPEG of quality 82 for a path with `.jpg`. The
/// same picture gives the same bytes. Errors: `Error` when it cannot be compressed or written.
void write_picture(const cv::Mat& bgr, const std::filesystem::path& path);

}  // namespace touchdown::render
