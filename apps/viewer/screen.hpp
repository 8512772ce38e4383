#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "render/film/plots.hpp"
#include "render/film/scene_view.hpp"

struct GLFWwindow;

namespace touchdown::viewer {

/// A pressed or repeated key. Letters are lower case; `shift`: Shift was held.
struct KeyPress {
  int key = 0;  ///< a character, or one of `Key`
  bool shift = false;
};

/// Keys that are no characters.
enum Key : int {
  key_left = 0x100000,
  key_right,
  key_up,
  key_down,
  key_home,
  key_end,
  key_escape,
  key_backspace,
  key_enter,
  key_delete
};

/// The mouse, in pixels from the window's upper left corner.
struct Mouse {
  double x = 0.0, y = 0.0;
  bool left = false, right = false;  ///< buttons that are down
  double scrolled = 0.0;             ///< since the last call, up positive
};

struct WindowInput {
  std::vector<KeyPress> keys;
  Mouse mouse;
};

/// A window with an OpenGL context, which is current in the thread that created it. One per
/// process. Errors: `Error` without a display.
class Window {
 public:
  Window(const std::string& title, int width, int height);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  bool is_open() const;
  void close();
  /// The drawn area (pixels).
  cv::Size size() const;

  void show();
  /// What the user did since the last call.
  WindowInput take_input();

 private:
  struct Callbacks;

  GLFWwindow* window_ = nullptr;
  WindowInput input_;
};

/// What a key does. The list of all keys, which `h` shows, is made of these.
struct KeyBinding {
  std::vector<int> keys;
  std::string label;  ///< the keys' names: "↑ ↓"
  std::string text;   ///< what they do
  std::function<void(const KeyPress& press)> act;
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

/// A rectangle in the window (pixels, from the upper left corner).
struct Area {
  int left, top, width, height;

  bool contains(double x, double y) const {
    return x >= left && x < left + width && y >= top && y < top + height;
  }
};

/// The areas of a window: the scene, perhaps a film beside it, a panel to their right, plots along
/// the lower edge.
struct Layout {
  Area scene, film, panel, plots;
};
/// What a window shows besides scene, panel and plots.
struct Extras {
  double film_aspect = 0.0;  ///< width over height of the film; 0: none
  int above_plots = 0;       ///< height of what is added to the plots (pixels)
};
Layout layout_of(int width, int height, const Extras& extras = {});

/// A label over the scene.
struct Chip {
  std::string text;
  unsigned colour;  ///< 0xRRGGBB
};

/// Colours of chips, as in films.
inline constexpr unsigned dark = 0x2b2f36, grey = 0x5c636e, green = 0x2f6f4f, brown = 0x8a6d1d,
                          orange = 0xd9760f, red = 0xb0304f;

/// The state of contact, by the number of wheels in contact.
Chip contact_chip(int wheels);

/// Whether time stands still, or its speed.
Chip running_chip(bool is_paused, double speed);

/// No picture follows another one sooner: the processor has more to do.
inline constexpr std::chrono::milliseconds shortest_frame{16};

/// Draws the robot and pictures into a window.
class Screen {
 public:
  explicit Screen(Window& window, const Extras& extras = {}) : window_(window), extras_(extras) {}

  /// Shows this robot on its terrain from now on. Keeps the reference.
  void set_robot(const models::RobotModel& robot) { view_.emplace(robot); }

  Layout layout() const { return layout_of(window_.size().width, window_.size().height, extras_); }
  CameraControl& camera() { return camera_; }
  const render::TextPen& pen() const { return pen_; }
  /// The robot's state: write its positions with `models::write_pose`, or with `Poses`.
  mjData& data() { return view_->data(); }

  void draw_scene(std::span<const render::SceneVector> vectors = {});
  void draw_chips(const std::vector<Chip>& chips);
  /// Draws a picture (8UC3, BGR) at a place of the window.
  void draw(const cv::Mat& picture, int left, int top);

  /// Adds the keys of the list, the camera and the end to these. Keeps their references.
  void bind(std::vector<KeyBinding> keys);
  /// Draws the list of all keys, and of what the mouse does, at the right edge of the scene, where
  /// it hides no robot, if the user wants it.
  void draw_keys(const std::vector<std::pair<std::string, std::string>>& mouse);
  /// Draws pictures and acts on keys until the window is closed or `stop` is true. `draw_picture`
  /// gets the time since the last picture (s).
  void watch(const std::atomic<bool>& stop, const std::function<void(double seconds)>& draw_picture,
             const std::function<void(const Mouse&)>& use_mouse);

  /// The point of the robot (m, world) under the mouse.
  std::optional<Eigen::Vector3d> robot_under(const Mouse& mouse) const;
  /// The motion of a point (m, world) that follows the mouse by these pixels (right, down).
  Eigen::Vector3d motion_of(const Eigen::Vector3d& point, double right, double down) const;

 private:
  mjrRect viewport() const;

  Window& window_;
  Extras extras_;
  render::TextPen pen_;
  CameraControl camera_;
  std::optional<render::SceneView> view_;
  cv::Mat upload_;
  std::vector<KeyBinding> bindings_;
  bool shows_keys_ = false;
};

}  // namespace touchdown::viewer
