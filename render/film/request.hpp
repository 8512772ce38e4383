#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

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

/// The wheels in true contact as `StripRow` has them, row by row; empty for a robot's log.
std::vector<std::uint8_t> wheels_in_contact(const logs::Recording& recording,
                                            const scoring::LabelConfig& labels);

/// A flight of one wheel: of the left one, 0, or the right one, 1.
struct WheelFlight {
  std::size_t wheel;
  double takeoff, landing;  ///< s
  bool is_whole;            ///< neither takeoff nor landing is an end of the run
};

/// The flights of both wheels of a simulated run, in order of their takeoffs, as the score counts
/// them: of at least `ScoringConfig::minimum_flight`. None of a robot's log.
std::vector<WheelFlight> wheel_flights(const logs::Recording& recording,
                                       const scoring::LabelConfig& labels);

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

/// The largest number of runs in a film.
inline constexpr std::size_t most_sources = 4;

/// A film of this width (px), rounded to an even one, with the given ratio of height to width.
VideoOptions film_of_width(double width, double ratio = 9.0 / 16.0);

/// Throws `InputError`, with the reason, if these runs cannot be drawn with these options.
void require_drawable(const std::vector<VideoSource>& sources, const VideoOptions& options);

}  // namespace touchdown::render
