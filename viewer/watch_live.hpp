#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "viewer/live_controls.hpp"

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

}  // namespace touchdown::viewer
