#pragma once

#include <string>
#include <vector>

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
  key_page_up,
  key_page_down,
  key_home,
  key_end,
  key_enter,
  key_escape,
  key_backspace
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

  /// False once the user has closed the window.
  bool is_open() const;
  void close();
  /// The drawn area (pixels).
  int width() const;
  int height() const;

  /// Shows what was drawn.
  void show();
  /// What the user did since the last call.
  WindowInput take_input();

 private:
  struct Callbacks;

  GLFWwindow* window_ = nullptr;
  WindowInput input_;
};

}  // namespace touchdown::viewer
