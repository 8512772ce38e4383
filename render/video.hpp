#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "experiments/labels.hpp"
#include "models/robot_model.hpp"
#include "recordings/recording.hpp"

namespace touchdown {

/// What one estimator believed along a recording: one number per row and wheel (left, right). A
/// vector that is empty is not drawn.
struct BeliefTrack {
  std::string name;
  std::array<std::vector<float>, wheel_count> p_contact;
  std::array<std::vector<float>, wheel_count> p_takeoff;
  std::array<std::vector<float>, wheel_count> p_landing;
};

enum class VideoQuality : int {
  draft,  ///< no anti-aliasing in the view
  page,   ///< drawn at twice the size and averaged
};

struct VideoOptions {
  int width = 1280;
  int height = 720;
  int fps = 30;
  VideoQuality quality = VideoQuality::draft;
  double from = 0.0;                                    ///< of the recording (s)
  double to = std::numeric_limits<double>::infinity();  ///< of the recording (s)
  double speed = 1.0;                                   ///< 0.1: ten times slower than life
  int crf = 21;                                         ///< of H.264: higher is smaller and worse
  std::string encoder = "libx264";                      ///< FFmpeg's name of it
  int workers = 0;                                      ///< processes; 0: one per core
  LabelConfig labels = {};                              ///< what counts as true contact
  /// Called after every frame; may be empty.
  std::function<void(int done, int of)> progress = {};
};

/// How long it took.
struct VideoStatistics {
  int frames = 0;
  double seconds = 0.0;           ///< from beginning to end
  double encoding_seconds = 0.0;  ///< of those, spent in the encoder's calls
  double first_frame_seconds = 0.0;
  double fps() const { return frames / seconds; }
};

/// One run as it is shown: the robot that was compiled for the run's terrain, and what it did.
struct VideoSource {
  const RobotModel& robot;
  const Recording& recording;
  const std::vector<BeliefTrack>& beliefs;
};

/// Film a run: the robot on its terrain, and below it the estimators' probabilities over the true
/// contact (a band: dark where both wheels touch, light where one does), the probabilities of
/// takeoff and landing of the first estimator that has them, and the left leg's torques. Thick
/// lines are the left wheel, thin ones the right.
///
/// The file is H.264 in mp4. The frames do not depend on the number of workers.
/// Errors: `InputError` for options or a recording that make no video; `Error` when it cannot be
/// written or drawn. Nothing is left behind then.
VideoStatistics render_video(const RobotModel& robot, const Recording& recording,
                             const std::vector<BeliefTrack>& beliefs, const VideoOptions& options,
                             const std::filesystem::path& path);

/// Two runs beside each other, aligned in time; the shorter one waits at its end.
VideoStatistics render_side_by_side(const VideoSource& left, const VideoSource& right,
                                    const VideoOptions& options, const std::filesystem::path& path);

/// The video's picture at `time` of the recording (s) as a PNG, or as a JPEG where the path says
/// `.jpg`; NaN: at the middle of the first run's first flight. Its quality is `page`, whatever
/// `options` says.
void render_poster(const RobotModel& robot, const Recording& recording,
                   const std::vector<BeliefTrack>& beliefs, const VideoOptions& options,
                   double time, const std::filesystem::path& path);

/// The same of one run or of two beside each other.
void render_poster(const std::vector<VideoSource>& sources, const VideoOptions& options,
                   double time, const std::filesystem::path& path);

/// The robot on its terrain alone, without labels and plots, as a PNG: the scene of a run.
void render_scene(const RobotModel& robot, const Recording& recording, const VideoOptions& options,
                  double time, const std::filesystem::path& path);

}  // namespace touchdown
