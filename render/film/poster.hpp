#pragma once

#include <filesystem>
#include <vector>

#include "render/film/request.hpp"
#include "render/film/source.hpp"

namespace touchdown::render {

/// The video's picture at `time` of the recording (s) as a PNG, or as a JPEG where the path says
/// `.jpg`; NaN: at the middle of the first run's first flight. Its quality is `page`, whatever
/// `options` says.
void render_poster(const std::vector<VideoSource>& sources, const VideoOptions& options,
                   double time, const std::filesystem::path& path);

/// The robot on its terrain alone, without labels and plots, as a PNG: the scene of a run.
void render_scene(const models::RobotModel& robot, const recordings::Recording& recording,
                  const VideoOptions& options, double time, const std::filesystem::path& path);

}  // namespace touchdown::render
