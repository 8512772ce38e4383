#pragma once

#include <vector>

#include "render/video.hpp"

namespace touchdown {

/// Throws `InputError`, saying what is wrong, if these runs cannot be drawn so.
void require_drawable(const std::vector<VideoSource>& sources, const VideoOptions& options);

}  // namespace touchdown
