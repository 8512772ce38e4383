#include "viewer/window.hpp"

#include <cctype>
#include <map>
#include <utility>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::viewer {

namespace {

/// 0 for a key without a meaning here.
int key_of(int glfw_key) {
  static const std::map<int, int> named = {{GLFW_KEY_LEFT, key_left},
                                           {GLFW_KEY_RIGHT, key_right},
                                           {GLFW_KEY_UP, key_up},
                                           {GLFW_KEY_DOWN, key_down},
                                           {GLFW_KEY_PAGE_UP, key_page_up},
                                           {GLFW_KEY_PAGE_DOWN, key_page_down},
                                           {GLFW_KEY_HOME, key_home},
                                           {GLFW_KEY_END, key_end},
                                           {GLFW_KEY_ENTER, key_enter},
                                           {GLFW_KEY_ESCAPE, key_escape},
                                           {GLFW_KEY_BACKSPACE, key_backspace}};
  if (const auto found = named.find(glfw_key); found != named.end()) return found->second;
  // GLFW numbers printable keys by the upper-case characters of a US keyboard.
  return glfw_key >= GLFW_KEY_SPACE && glfw_key <= GLFW_KEY_GRAVE_ACCENT ? std::tolower(glfw_key)
                                                                         : 0;
}

std::string last_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "no reason given" : text;
}

[[noreturn]] void complain_about_display() {
  throw Error(fmt::format(
      "watch: no window can be opened ({}). Without a display, `touchdown simulate` and "
      "`touchdown render` make a film",
      last_error()));
}

}  // namespace

struct Window::Callbacks {
  static WindowInput& input(GLFWwindow* window) {
    return static_cast<Window*>(glfwGetWindowUserPointer(window))->input_;
  }

  static void key(GLFWwindow* window, int key, int scancode, int action, int modifiers) {
    if (action == GLFW_RELEASE) return;
    // A letter is found by what its key writes on the user's keyboard, not by its place.
    int meaning = key_of(key);
    const char* const written = glfwGetKeyName(key, scancode);
    if (written != nullptr && written[0] != '\0' && written[1] == '\0') {
      meaning = std::tolower(static_cast<unsigned char>(written[0]));
    }
    if (meaning == 0) return;
    input(window).keys.push_back({meaning, (modifiers & GLFW_MOD_SHIFT) != 0});
  }

  static void scroll(GLFWwindow* window, double /*x*/, double y) {
    input(window).mouse.scrolled += y;
  }
};

Window::Window(const std::string& title, int width, int height) {
  if (glfwInit() == GLFW_FALSE) complain_about_display();
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr) {
    glfwTerminate();
    complain_about_display();
  }
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, Callbacks::key);
  glfwSetScrollCallback(window_, Callbacks::scroll);
  glfwSetInputMode(window_, GLFW_STICKY_MOUSE_BUTTONS, GLFW_TRUE);  // a click between two pictures
  constexpr int least_width = 800;
  constexpr int least_height = 600;
  glfwSetWindowSizeLimits(window_, least_width, least_height, GLFW_DONT_CARE, GLFW_DONT_CARE);
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool Window::is_open() const { return glfwWindowShouldClose(window_) == GLFW_FALSE; }
void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }

int Window::width() const {
  int width = 0;
  glfwGetFramebufferSize(window_, &width, nullptr);
  return width;
}

int Window::height() const {
  int height = 0;
  glfwGetFramebufferSize(window_, nullptr, &height);
  return height;
}

void Window::show() { glfwSwapBuffers(window_); }

WindowInput Window::take_input() {
  glfwPollEvents();
  Mouse& mouse = input_.mouse;
  glfwGetCursorPos(window_, &mouse.x, &mouse.y);
  int window_width = 1;
  glfwGetWindowSize(window_, &window_width, nullptr);
  const double scale = static_cast<double>(width()) / (window_width > 0 ? window_width : 1);
  mouse.x *= scale;
  mouse.y *= scale;
  mouse.left = glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
  mouse.right = glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS;
  WindowInput taken = std::exchange(input_, {});
  return taken;
}

}  // namespace touchdown::viewer
