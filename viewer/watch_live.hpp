#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/logs/estimator.hpp"
#include "viewer/live/run.hpp"

namespace touchdown::viewer {

/// What a user asked to watch live.
struct LiveRequest {
  LiveScene scene;
  std::vector<experiments::LogEstimator> estimators;
  LiveSettings settings;
  std::vector<std::pair<std::string, noise::SensorProfile>> sensors;  ///< that `p` changes between
  std::filesystem::path record = {};  ///< recording to write at the end; empty: none
  int width = 1280, height = 720;     ///< of the window
};

/// The result of a session.
struct LiveSession {
  std::vector<std::string> recorded;  ///< one line per recording
  int frames = 0;
  double seconds = 0.0;  ///< of the session
};

/// Shows a robot in a window and lets the user drive it, until the window is closed or `stop` is
/// true. Errors: `Error` without a display.
LiveSession watch_live(LiveRequest request, const std::atomic<bool>& stop);

}  // namespace touchdown::viewer
