#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "apps/viewer/widgets.hpp"
#include "render/film/scene_view.hpp"

struct GLFWwindow;

namespace touchdown::viewer {

/// A pressed or repeated key: the lower-case character that it writes, or GLFW's number of a key
/// that writes none. `shift`: Shift was held.
struct KeyPress {
  int key = 0;
  bool shift = false;
};

/// The camera, which follows the robot, and which a user turns and moves closer.
class CameraControl {
 public:
  /// The next of the modes: film, behind, side, above.
  void next_mode();

  /// Turns the camera by a motion of the mouse (pixels).
  void turn(double right, double down);
  /// Moves it closer by steps of the mouse wheel.
  void approach(double steps);

  /// Follows the robot's base (m, world) smoothly. `seconds` since the last call; 0 jumps there.
  void follow(const Eigen::Vector3d& base, double seconds);

  const render::SceneCamera& camera() const { return camera_; }
  const Eigen::Vector3d& target() const { return target_; }

 private:
  std::size_t mode_ = 0;
  render::SceneCamera camera_;
  Eigen::Vector3d target_ = Eigen::Vector3d::Zero();
  bool follows_ = false;
};

/// The areas of a window: the scene, perhaps a film beside it, a panel to their right, plots along
/// the lower edge.
struct Layout {
  Area scene, film, panel, plots;
};
/// What a window shows besides scene, panel and plots.
struct Extras {
  double film_aspect = 0.0;  ///< width over height of the film; 0: none
  float above_plots = 0.0F;  ///< height of what is added to the plots (pixels)
};

/// A label over the scene.
struct Chip {
  std::string text;
  unsigned colour;  ///< 0xRRGGBB
};

/// The state of contact, by the number of wheels in contact.
Chip contact_chip(int wheels);

/// Whether time stands still, or its speed.
Chip running_chip(bool is_paused, double speed);

/// No picture follows another one sooner: the processor has more to do.
inline constexpr std::chrono::milliseconds shortest_frame{16};

/// A window in which the robot is drawn, with labels and widgets of Dear ImGui, and with keys that
/// act. Its OpenGL context is current in the thread that created it. One per process.
class Screen {
 public:
  /// Errors: `Error` without a display or a font.
  Screen(const std::string& title, int width, int height, const Extras& extras = {});
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  /// Shows this robot on its terrain from now on. Keeps the reference.
  void set_robot(const models::RobotModel& robot) { view_.emplace(robot); }
  /// Acts on keys. The list that `h` shows has their names, "↑ ↓", and what they do. Without keys,
  /// it has what the mouse does.
  void bind(std::vector<int> keys, std::string names, std::string text,
            std::function<void(const KeyPress& press)> act = {});
  /// Draws pictures and acts on keys until the window is closed or `stop` is true. `draw_picture`
  /// makes widgets and ends with `draw_widgets` and `show`. It gets the time since the last picture
  /// (s).
  void watch(const std::atomic<bool>& stop,
             const std::function<void(double seconds)>& draw_picture);

  Layout layout() const;
  CameraControl& camera() { return camera_; }
  /// The robot's state: write its positions with `models::write_pose`, or with `Poses`.
  mjData& data() { return view_->data(); }

  void draw_scene(std::span<const render::SceneVector> vectors = {});
  /// Draws a picture (8UC3, BGR) in an area, as large as it fits, on black.
  void draw_picture(const cv::Mat& picture, const Area& area);
  /// Draws labels from an area's upper left corner on, in as many lines as they need.
  void draw_chips(const std::vector<Chip>& chips, const Area& area);
  /// Draws the list of keys, if the user wants it, and all widgets, over the picture.
  void draw_widgets();
  void show();

  bool has_mouse_on_robot() const;
  /// Turns and moves the camera with the mouse.
  void move_camera();
  /// The motion of a point (m, world) that follows the mouse since the last picture.
  Eigen::Vector3d motion_of(const Eigen::Vector3d& point) const;

 private:
  struct Callbacks;
  struct KeyBinding {
    std::vector<int> keys;
    std::string names, text;
    std::function<void(const KeyPress& press)> act;
  };

  /// Whether the mouse is over the scene and holds no widget.
  bool has_mouse() const;
  void draw_keys() const;

  GLFWwindow* window_ = nullptr;
  Extras extras_;
  CameraControl camera_;
  std::optional<render::SceneView> view_;
  std::vector<KeyBinding> bindings_;
  std::vector<KeyPress> pressed_;  ///< since the last picture
  bool shows_keys_ = false;
};

}  // namespace touchdown::viewer
