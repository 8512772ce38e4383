#pragma once

#include <filesystem>
#include <vector>

#include "render/film/request.hpp"

namespace touchdown::render {

/// How long it took.
struct VideoStatistics {
  int frames = 0;
  double seconds = 0.0;           ///< from beginning to end
  double encoding_seconds = 0.0;  ///< of those, spent in the encoder's calls
  double first_frame_seconds = 0.0;
  double fps() const { return frames / seconds; }
};

/// Film a run: the robot on its terrain, and below it the estimators' probabilities over the true
/// contact (a band: dark where both wheels touch, light where one does), the probabilities of
/// takeoff and landing of the first estimator that has them, and the left leg's torques. Thick
/// lines are the left wheel, thin ones the right. Several runs stand beside each other, aligned in
/// time; the shorter ones wait at their ends.
///
/// The file is H.264 in mp4. The frames do not depend on the number of workers.
/// Errors: `InputError` for options or a recording that make no video; `Error` when it cannot be
/// written or drawn. Nothing is left behind then.
VideoStatistics render_video(const std::vector<VideoSource>& sources, const VideoOptions& options,
                             const std::filesystem::path& path);

/// The video's picture at `time` of the recording (s) as a PNG, or as a JPEG where the path says
/// `.jpg`; NaN: at the middle of the first run's first flight. Its quality is `page`, whatever
/// `options` says.
void render_poster(const std::vector<VideoSource>& sources, const VideoOptions& options,
                   double time, const std::filesystem::path& path);

/// The robot on its terrain alone, without labels and plots, as a PNG: the scene of a run.
void render_scene(const models::RobotModel& robot, const recordings::Recording& recording,
                  const VideoOptions& options, double time, const std::filesystem::path& path);

}  // namespace touchdown::render
