#pragma once

#include <functional>
#include <vector>

#include "viewer/live_controls.hpp"
#include "viewer/screen/camera_control.hpp"
#include "viewer/screen/keys.hpp"

namespace touchdown::viewer {

/// What keys change besides the run.
struct WindowActions {
  std::function<void()> toggle_list, next_camera, quit;
};

/// The keys of a live run. Keeps the reference.
std::vector<KeyBinding> live_keys(LiveControls& controls, const WindowActions& window);

}  // namespace touchdown::viewer
