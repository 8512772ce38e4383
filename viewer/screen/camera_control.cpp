#include "viewer/screen/camera_control.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace touchdown::viewer {

namespace {

struct CameraMode {
  const char* name;
  render::SceneCamera camera;
};

const std::array<CameraMode, 4>& modes() {
  static const std::array<CameraMode, 4> all = {{
      {"film", {}},
      {"behind", {.azimuth = 0.0, .elevation = -12.0, .distance = 2.2}},
      {"side", {.azimuth = 90.0, .elevation = -4.0, .distance = 2.2}},
      {"above", {.azimuth = 90.0, .elevation = -75.0, .distance = 3.0}},
  }};
  return all;
}

constexpr double degrees_per_pixel = 0.3;
constexpr double zoom_per_step = 0.9;
constexpr double nearest = 0.4, farthest = 20.0;  // m
constexpr double highest = 89.0;                  // degrees
constexpr double follow_time = 0.25;              // s

}  // namespace

void CameraControl::next_mode() {
  mode_ = (mode_ + 1) % modes().size();
  camera_ = modes()[mode_].camera;
}

std::string CameraControl::mode() const { return modes()[mode_].name; }

void CameraControl::turn(double right, double down) {
  camera_.azimuth = std::remainder(camera_.azimuth - degrees_per_pixel * right, 360.0);
  camera_.elevation = std::clamp(camera_.elevation - degrees_per_pixel * down, -highest, highest);
}

void CameraControl::approach(double steps) {
  camera_.distance =
      std::clamp(camera_.distance * std::pow(zoom_per_step, steps), nearest, farthest);
}

void CameraControl::follow(const Eigen::Vector3d& base, double seconds) {
  if (!base.allFinite()) return;
  const bool jumps = seconds <= 0.0 || !follows_;
  target_ += (jumps ? 1.0 : 1.0 - std::exp(-seconds / follow_time)) * (base - target_);
  follows_ = true;
}

}  // namespace touchdown::viewer
