#pragma once

#include <filesystem>
#include <vector>

#include "render/film/request.hpp"

namespace touchdown::render {

/// The computing time of a video.
struct VideoStatistics {
  int frames = 0;
  double seconds = 0.0;
  double fps() const { return frames / seconds; }
};

/// Films a run: the robot on its terrain, with plots below. The plots show the estimators' contact
/// probabilities over the true contact (green: of the left wheel above, of the right one below),
/// takeoff and landing probabilities of the first estimator that has them, and the left
/// leg's torques. Thick lines are the left wheel, thin lines the right. Several runs are side by
/// side, aligned in time; shorter ones stop at their ends.
///
/// The file is H.264 in mp4. The frames do not depend on the number of workers.
/// Errors: `InputError` for options or a recording that give no video; `Error` when it cannot be
/// written or drawn. After an error there is no file.
VideoStatistics render_video(const std::vector<VideoSource>& sources, const VideoOptions& options,
                             const std::filesystem::path& path);

/// The middle of the first flight of a wheel within the run, or else of the run (s).
double first_flight(const logs::Recording& recording, const scoring::LabelConfig& labels);

/// Writes the video's picture at `time` of the recording (s) as a PNG, or as a JPEG for a path with
/// `.jpg`. NaN means the middle of the first run's first flight. The quality is always `page`.
void render_poster(const std::vector<VideoSource>& sources, const VideoOptions& options,
                   double time, const std::filesystem::path& path);

/// Writes a picture of the robot on its terrain, without labels and plots, as a PNG.
void render_scene(const models::RobotModel& robot, const logs::Recording& recording,
                  const VideoOptions& options, double time, const std::filesystem::path& path);

}  // namespace touchdown::render
