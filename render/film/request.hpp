#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "models/robot_model.hpp"
#include "recordings/recording.hpp"
#include "render/encode/writer.hpp"
#include "scoring/labels.hpp"

namespace touchdown::render {

/// What one estimator believed along a recording: one number per row and wheel (left, right). A
/// vector that is empty is not drawn.
struct BeliefTrack {
  std::string name;
  std::array<std::vector<float>, models::wheel_count> p_contact;
  std::array<std::vector<float>, models::wheel_count> p_takeoff;
  std::array<std::vector<float>, models::wheel_count> p_landing;
};

/// One run as it is shown: the robot that was compiled for the run's terrain, and what it did.
struct VideoSource {
  const models::RobotModel& robot;
  const recordings::Recording& recording;
  const std::vector<BeliefTrack>& beliefs;
  std::string label = {};  ///< what it is called; empty: by its engine
};

/// How many wheels truly touched the ground, row by row; empty for a robot's log.
std::vector<std::uint8_t> wheels_in_contact(const recordings::Recording& recording,
                                            const scoring::LabelConfig& labels);

/// What a run is called: by its label, or "MuJoCo", "Bullet", "robot log".
std::string label_of(const VideoSource& source);

enum class VideoQuality : int {
  draft,  ///< no anti-aliasing in the view
  page,   ///< drawn at twice the size and averaged
};

struct VideoOptions : VideoFormat {
  VideoQuality quality = VideoQuality::draft;
  double from = 0.0;                                    ///< of the recording (s)
  double to = std::numeric_limits<double>::infinity();  ///< of the recording (s)
  double speed = 1.0;                                   ///< 0.1: ten times slower than life
  int workers = 0;                                      ///< processes; 0: one per core
  scoring::LabelConfig labels = {};                     ///< what counts as true contact
  /// Called after every frame; may be empty.
  std::function<void(int done, int of)> progress = {};
};

/// As many runs have room beside each other.
inline constexpr std::size_t most_sources = 4;

/// Throws `InputError`, saying what is wrong, if these runs cannot be drawn so.
void require_drawable(const std::vector<VideoSource>& sources, const VideoOptions& options);

}  // namespace touchdown::render
