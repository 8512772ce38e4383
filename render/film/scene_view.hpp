#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <mujoco/mujoco.h>

#include "models/robot_model.hpp"

namespace touchdown::render {

/// An OpenGL context that draws into plain memory, without a display or a GPU, and is current in
/// the thread that made it for as long as it lives.
///
/// All contexts of one process share one rasteriser: for more speed use more processes
/// (`paint_in_order`). Never fork a process that has one. Errors: `Error` when Mesa cannot make it.
class GlContext {
 public:
  GlContext(int width, int height);
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Waits until all drawing is in `pixels`.
  void finish();

  /// BGRA, 8 bits each, rows from the top, no padding.
  std::uint8_t* pixels() { return pixels_.data(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  int width_;
  int height_;
  std::vector<std::uint8_t> pixels_;
  void* context_ = nullptr;
};

/// Draws one robot on its terrain with MuJoCo's renderer into the GL context that is current. That
/// context must outlive it. The shadows' sharp region and the camera follow the robot.
class SceneView {
 public:
  /// Keeps a reference to `robot`.
  explicit SceneView(const models::RobotModel& robot);
  ~SceneView();
  SceneView(const SceneView&) = delete;
  SceneView& operator=(const SceneView&) = delete;

  /// Where the robot is: fill with `Poses::apply`.
  mjData& data() { return *data_; }

  /// Draws `data()` into `viewport`, looked at around `target` (m, world).
  void draw(const mjrRect& viewport, const Eigen::Vector3d& target);

 private:
  void place_sun(const Eigen::Vector3d& target);
  void switch_haze_on();

  const models::RobotModel& robot_;
  models::MjDataPtr data_;
  mjvScene scene_;
  mjvOption visibility_;
  mjvCamera camera_;
  mjrContext context_;
};

}  // namespace touchdown::render
