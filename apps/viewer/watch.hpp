#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/viewer/live_controls.hpp"
#include "logs/recording.hpp"
#include "models/robot_model.hpp"
#include "render/film/request.hpp"

namespace touchdown::viewer {

/// The times of a session's pictures (s, all of them added).
struct PictureTimes {
  double scene = 0.0;    ///< MuJoCo draws robot and terrain
  double overlay = 0.0;  ///< labels, panel and plots are painted and copied into the window
  double display = 0.0;  ///< the window system shows the picture
};

/// The result of a session.
struct LiveSession {
  std::vector<std::string> recorded;  ///< one line per recording
  int frames = 0;
  double seconds = 0.0;               ///< of the session
  std::optional<PictureTimes> times;  ///< if the request measures them
};

/// Shows a robot in a window and lets the user drive it, until the window is closed or `stop` is
/// true. Errors: `Error` without a display.
LiveSession watch_live(LiveRequest request, const std::atomic<bool>& stop);

/// A recording or log with everything that is shown of it.
struct LoggedRun {
  std::string name;
  models::RobotModel robot;
  logs::Recording recording;
  std::vector<render::BeliefTrack> beliefs;
  /// True contact by row, from ground truth or labels; empty without them.
  std::array<std::vector<std::uint8_t>, models::wheel_count> contact;
};

/// A segment of a run: steps [begin, end).
struct StepRange {
  std::size_t begin, end;

  bool operator==(const StepRange&) const = default;
};

/// The steps at which `values` is true, as maximal ranges.
std::vector<StepRange> ranges_of(const std::vector<std::uint8_t>& values);

/// The flights of the run: no wheel in true contact; without true contact, none by the first
/// estimator's beliefs.
std::vector<StepRange> flights_of(const LoggedRun& run);

/// Where the decision of estimator `index` differs from the true contact of a wheel for at least
/// 5 ms. Empty without true contact.
std::vector<StepRange> errors_of(const LoggedRun& run, std::size_t index);

/// Plays the run in a window until the window is closed or `stop` is true. Errors: `Error` without
/// a display.
void watch_log(const LoggedRun& run, int width, int height, const std::atomic<bool>& stop);

}  // namespace touchdown::viewer
