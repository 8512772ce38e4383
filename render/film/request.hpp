#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <opencv2/core/types.hpp>

#include "logs/recording.hpp"
#include "models/robot_model.hpp"
#include "render/film/encode.hpp"
#include "render/palette.hpp"
#include "scoring/labels.hpp"

namespace touchdown::render {

/// One estimator's beliefs along a recording: one number per row and wheel (left, right). Empty
/// vectors are not drawn.
struct BeliefTrack {
  std::string name;
  unsigned colour = line_colours.front();  ///< of its curves (0xRRGGBB)
  std::array<std::vector<float>, models::wheel_count> p_contact;
  std::array<std::vector<float>, models::wheel_count> p_takeoff;
  std::array<std::vector<float>, models::wheel_count> p_landing;
  std::array<std::vector<std::uint8_t>, models::wheel_count> contact = {};  ///< its decisions
};

/// One run of a film: the robot that was compiled for the run's terrain, the recording, and the
/// beliefs to draw.
struct VideoSource {
  const models::RobotModel& robot;
  const logs::Recording& recording;
  const std::vector<BeliefTrack>& beliefs;
  std::string label = {};  ///< shown in the film; empty: the name of its engine
};

/// The number of wheels in true contact, row by row; empty for a robot's log.
std::vector<std::uint8_t> wheels_in_contact(const logs::Recording& recording,
                                            const scoring::LabelConfig& labels);

/// Flights of both wheels of a simulated run that are long enough to be seen; none of a robot's
/// log.
std::vector<scoring::Flight> visible_flights(const logs::Recording& recording,
                                             scoring::LabelConfig labels);

/// A run's label, or else "MuJoCo", "Bullet" or "robot log".
std::string label_of(const VideoSource& source);

enum class VideoQuality : int {
  draft,  ///< no anti-aliasing in the view
  page,   ///< drawn `page_oversampling` times as wide and high, and averaged
};
/// Edges look as at 2, with 0.56 times its pixels.
inline constexpr double page_oversampling = 1.5;

struct VideoOptions : VideoFormat {
  VideoQuality quality = VideoQuality::draft;
  double from = 0.0;                                    ///< of the recording (s)
  double to = std::numeric_limits<double>::infinity();  ///< of the recording (s)
  double speed = 1.0;                                   ///< 0.1: ten times slower than real time
  int workers = 0;                                      ///< processes; 0: one per core
  scoring::LabelConfig labels = {};                     ///< what counts as true contact
  /// Called after every frame; may be empty.
  std::function<void(int done, int of)> progress = {};
};

/// A picture of a film as a file.
struct Still {
  std::filesystem::path path;  ///< a JPEG
  double time = 0.0;           ///< of the recording (s)
};

/// One of several films of the same runs.
struct Film {
  std::vector<std::size_t> runs;  ///< those that it shows, as indices of the sources
  VideoOptions options;
  std::filesystem::path path = {};
  std::optional<Still> still = {};  ///< the frame that is nearest to its time
  /// The size at which views are painted at least, before they are reduced to their place.
  std::optional<cv::Size> least_view = {};
};

/// The largest number of runs in a film.
inline constexpr std::size_t most_sources = 4;

/// Throws `InputError`, with the reason, if these runs cannot be drawn with these options.
void require_drawable(const std::vector<VideoSource>& sources, const VideoOptions& options);

}  // namespace touchdown::render
