#include "apps/viewer/screen.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <map>
#include <thread>

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"

namespace touchdown::viewer {

namespace {

/// 0 for a key without a meaning here.
int key_of(int glfw_key) {
  static const std::map<int, int> named = {
      {GLFW_KEY_LEFT, key_left},     {GLFW_KEY_RIGHT, key_right},
      {GLFW_KEY_UP, key_up},         {GLFW_KEY_DOWN, key_down},
      {GLFW_KEY_HOME, key_home},     {GLFW_KEY_END, key_end},
      {GLFW_KEY_ESCAPE, key_escape}, {GLFW_KEY_BACKSPACE, key_backspace},
      {GLFW_KEY_ENTER, key_enter},   {GLFW_KEY_KP_ENTER, key_enter},
      {GLFW_KEY_DELETE, key_delete}};
  if (const auto found = named.find(glfw_key); found != named.end()) return found->second;
  // GLFW numbers printable keys by the upper-case characters of a US keyboard.
  return glfw_key >= GLFW_KEY_SPACE && glfw_key <= GLFW_KEY_GRAVE_ACCENT ? std::tolower(glfw_key)
                                                                         : 0;
}

[[noreturn]] void complain_about_display() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  throw Error(fmt::format(
      "watch: no window can be opened ({}). Without a display, `touchdown simulate` and "
      "`touchdown render` make a film",
      reason == nullptr ? "no reason given" : reason));
}

/// The cameras: as in films, behind the robot, at its side, above it.
const std::array<render::SceneCamera, 4>& cameras() {
  static const std::array<render::SceneCamera, 4> all = {{
      {},
      {.azimuth = 0.0, .elevation = -12.0, .distance = 2.2},
      {.azimuth = 90.0, .elevation = -4.0, .distance = 2.2},
      {.azimuth = 90.0, .elevation = -75.0, .distance = 3.0},
  }};
  return all;
}

constexpr double degrees_per_pixel = 0.3;
constexpr double zoom_per_step = 0.9;
constexpr double nearest = 0.4, farthest = 20.0;  // m
constexpr double lowest = 10.0;                   // degrees, looking up
constexpr double highest = -89.0;                 // degrees, looking down
constexpr double follow_time = 0.25;              // s

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

cv::Size Window::size() const {
  cv::Size size;
  glfwGetFramebufferSize(window_, &size.width, &size.height);
  return size;
}

void Window::show() { glfwSwapBuffers(window_); }

WindowInput Window::take_input() {
  glfwPollEvents();
  Mouse& mouse = input_.mouse;
  glfwGetCursorPos(window_, &mouse.x, &mouse.y);
  int window_width = 1;
  glfwGetWindowSize(window_, &window_width, nullptr);
  const double scale = static_cast<double>(size().width) / (window_width > 0 ? window_width : 1);
  mouse.x *= scale;
  mouse.y *= scale;
  mouse.left = glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
  mouse.right = glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS;
  WindowInput taken = std::exchange(input_, {});
  return taken;
}

/// Acts on pressed keys, in their order. Keys without a binding do nothing.
static void act_on(const std::vector<KeyBinding>& bindings, const std::vector<KeyPress>& presses) {
  for (const KeyPress& press : presses) {
    for (const KeyBinding& binding : bindings) {
      const auto& keys = binding.keys;
      if (std::find(keys.begin(), keys.end(), press.key) != keys.end()) binding.act(press);
    }
  }
}

/// The list of keys and of what the mouse does, at most `width`·`height` pixels.
static cv::Mat key_list(const render::TextPen& pen, const std::vector<KeyBinding>& bindings,
                        const std::vector<std::pair<std::string, std::string>>& mouse, int width,
                        int height) {
  std::vector<std::pair<std::string, std::string>> lines;
  for (const KeyBinding& binding : bindings) lines.emplace_back(binding.label, binding.text);
  lines.insert(lines.end(), mouse.begin(), mouse.end());
  const int count = static_cast<int>(lines.size());
  const int line = std::clamp((height - 24) / std::max(1, count), 10, 18);
  const int letters = line * 6 / 10;
  int labels = 0;
  int texts = 0;
  for (const auto& [label, text] : lines) {
    labels = std::max(labels, pen.width(label, letters));
    texts = std::max(texts, pen.width(text, letters));
  }
  const int margin = line;
  cv::Mat image(std::min(height, count * line + 2 * (margin / 2)),
                std::min(width, labels + texts + 3 * margin), CV_8UC3, render::strip_paper);
  int top = margin / 2;
  for (const auto& [label, text] : lines) {
    pen.write(image, label, margin, top, letters, render::rgb(0x0072b2));
    pen.write(image, text, 2 * margin + labels, top, letters, render::strip_ink);
    top += line;
  }
  return image;
}

void CameraControl::next_mode() {
  mode_ = (mode_ + 1) % cameras().size();
  camera_ = cameras()[mode_];
}

void CameraControl::turn(double right, double down) {
  camera_.azimuth = std::remainder(camera_.azimuth - degrees_per_pixel * right, 360.0);
  camera_.elevation = std::clamp(camera_.elevation - degrees_per_pixel * down, highest, lowest);
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

Layout layout_of(int width, int height, const Extras& extras) {
  const int plots = std::clamp(height * 36 / 100, 160, 420) + extras.above_plots;
  const int panel = std::clamp(width * 24 / 100, 220, 420);
  const int above = std::max(1, height - plots);
  const int left = std::max(2, width - panel);
  // At most half for the film, as far as its height fills it.
  const int film = std::min(left / 2, static_cast<int>(std::lround(extras.film_aspect * above)));
  const int scene = left - film;
  return {{0, 0, scene, above},
          {scene, 0, film, above},
          {left, 0, panel, above},
          {0, above, width, plots}};
}

Chip contact_chip(int wheels) {
  if (wheels == 0) return {"IN THE AIR", orange};
  return wheels == 1 ? Chip{"ON ONE WHEEL", brown} : Chip{"ON THE GROUND", green};
}

Chip running_chip(bool is_paused, double speed) {
  return is_paused ? Chip{"PAUSED", dark} : Chip{fmt::format("{:.3g}× speed", speed), dark};
}

mjrRect Screen::viewport() const {
  const Area scene = layout().scene;
  return {scene.left, window_.size().height - scene.top - scene.height, scene.width, scene.height};
}

void Screen::draw_scene(std::span<const render::SceneVector> vectors) {
  view_->draw(viewport(), camera_.target(), camera_.camera(), vectors);
}

void Screen::draw(const cv::Mat& picture, int left, int top) {
  cv::Mat flipped;
  cv::flip(picture, flipped, 0);  // OpenGL counts from below
  cv::cvtColor(flipped, upload_, cv::COLOR_BGR2RGB);
  view_->copy(upload_.data,
              {left, window_.size().height - top - picture.rows, picture.cols, picture.rows});
}

void Screen::draw_keys(const std::vector<std::pair<std::string, std::string>>& mouse) {
  if (!shows_keys_) return;
  const Area scene = layout().scene;
  const int right = scene.left + scene.width + layout().film.width;
  const cv::Mat picture = key_list(pen_, bindings_, mouse, right, scene.height);
  draw(picture, std::max(0, right - picture.cols),
       scene.top + std::max(0, (scene.height - picture.rows) / 2));
}

void Screen::bind(std::vector<KeyBinding> keys) {
  bindings_ = {
      {{'h'}, "h", "show or hide this list", [this](auto&) { shows_keys_ = !shows_keys_; }}};
  std::move(keys.begin(), keys.end(), std::back_inserter(bindings_));
  bindings_.push_back({{'v'}, "v", "next camera", [this](auto&) { camera_.next_mode(); }});
  bindings_.push_back({{'q', key_escape}, "q  Esc", "quit", [this](auto&) { window_.close(); }});
}

void Screen::watch(const std::atomic<bool>& stop, const std::function<void(double)>& draw_picture,
                   const std::function<void(const Mouse&)>& use_mouse) {
  using Clock = std::chrono::steady_clock;
  Clock::time_point last = Clock::now();
  while (window_.is_open() && !stop) {
    const Clock::time_point now = Clock::now();
    draw_picture(std::chrono::duration<double>(now - last).count());
    last = now;
    const WindowInput input = window_.take_input();
    act_on(bindings_, input.keys);
    use_mouse(input.mouse);
    std::this_thread::sleep_until(now + shortest_frame);
  }
}

void Screen::draw_chips(const std::vector<Chip>& chips) {
  constexpr int height = 28;
  int left = height / 2;
  int top = height / 2;
  for (const Chip& chip : chips) {
    const int width = pen_.width(chip.text, height / 2) + 2 * (2 * height / 5);
    if (left > height / 2 && left + width > layout().scene.width) {  // in the next line
      left = height / 2;
      top += height + height / 3;
    }
    cv::Mat image(height, width, CV_8UC3);
    pen_.chip(image, chip.text, 0, 0, height, render::rgb(chip.colour));
    draw(image, left, top);
    left += width + height / 3;
  }
}

std::optional<Eigen::Vector3d> Screen::robot_under(const Mouse& mouse) const {
  const Area scene = layout().scene;
  return view_->robot_at(viewport(), (mouse.x - scene.left) / scene.width,
                         1.0 - (mouse.y - scene.top) / scene.height);
}

Eigen::Vector3d Screen::motion_of(const Eigen::Vector3d& point, double right, double down) const {
  return view_->motion_of(viewport(), point, {right, -down});
}

}  // namespace touchdown::viewer
