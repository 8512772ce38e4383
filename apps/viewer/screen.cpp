#include "apps/viewer/screen.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <thread>
#include <utility>

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "render/film/plots.hpp"

namespace touchdown::viewer {

namespace {

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

/// Pixels per unit of the window: more than one on displays of high resolution.
float pixel_scale() { return ImGui::GetIO().DisplayFramebufferScale.x; }

/// The pixels of an area of the window, which OpenGL counts from below.
mjrRect pixels_of(const Area& area) {
  const auto pixels = [](float length) {
    return static_cast<int>(std::lround(length * pixel_scale()));
  };
  const float bottom = ImGui::GetIO().DisplaySize.y - area.top - area.height;
  return {pixels(area.left), pixels(bottom), pixels(area.width), pixels(area.height)};
}

}  // namespace

struct Screen::Callbacks {
  static void key(GLFWwindow* window, int key, int scancode, int action, int modifiers) {
    if (action == GLFW_RELEASE || ImGui::GetIO().WantTextInput) return;
    // A letter is found by what its key writes on the user's keyboard, not by its place. Without a
    // name, GLFW numbers printable keys by the upper-case characters of a US keyboard.
    int meaning = key <= GLFW_KEY_GRAVE_ACCENT ? std::tolower(std::max(0, key)) : key;
    const char* const written = glfwGetKeyName(key, scancode);
    if (written != nullptr && written[0] != '\0' && written[1] == '\0') {
      meaning = std::tolower(static_cast<unsigned char>(written[0]));
    }
    auto& screen = *static_cast<Screen*>(glfwGetWindowUserPointer(window));
    screen.pressed_.push_back({meaning, (modifiers & GLFW_MOD_SHIFT) != 0});
  }
};

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

Chip contact_chip(int wheels) {
  if (wheels == 0) return {"IN THE AIR", orange};
  return wheels == 1 ? Chip{"ON ONE WHEEL", brown} : Chip{"ON THE GROUND", green};
}

Chip running_chip(bool is_paused, double speed) {
  return is_paused ? Chip{"PAUSED", dark} : Chip{fmt::format("{:.3g}× speed", speed), dark};
}

/// Makes Dear ImGui's state, with our font and colours.
static void begin_widgets(GLFWwindow* window, const std::string& font) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // nothing is remembered
  ImGui::StyleColorsLight();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowBorderSize = 0.0F;
  style.FramePadding = {4.0F, 1.0F};
  style.ItemSpacing = {8.0F, 3.0F};
  style.Colors[ImGuiCol_WindowBg] = ImGui::ColorConvertU32ToFloat4(colour_of(paper));
  style.Colors[ImGuiCol_FrameBg] = ImGui::ColorConvertU32ToFloat4(colour_of(0xdfe3e6));
  style.Colors[ImGuiCol_SliderGrab] = ImGui::ColorConvertU32ToFloat4(colour_of(0x0072b2));
  style.Colors[ImGuiCol_Text] = ImGui::ColorConvertU32ToFloat4(colour_of(ink));
  constexpr float letters = 15.0F;  // px
  // Latin, Greek and Cyrillic letters, punctuation, arrows, signs of mathematics.
  static constexpr ImWchar characters[] = {0x20, 0x52f, 0x2010, 0x203a, 0x2190, 0x22ff, 0};
  ImGui::GetIO().Fonts->AddFontFromFileTTF(font.c_str(), letters, nullptr, characters);
  ImGui_ImplGlfw_InitForOpenGL(window, true);  // calls what was set before, too
  ImGui_ImplOpenGL3_Init();
}

Screen::Screen(const std::string& title, int width, int height, const Extras& extras)
    : extras_(extras) {
  const std::string font = render::font_file();
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
  constexpr int least_width = 800;
  constexpr int least_height = 600;
  glfwSetWindowSizeLimits(window_, least_width, least_height, GLFW_DONT_CARE, GLFW_DONT_CARE);
  begin_widgets(window_, font);
  bind({'h'}, "h", "show or hide this list", [this](auto&) { shows_keys_ = !shows_keys_; });
  bind({'v'}, "v", "next camera", [this](auto&) { camera_.next_mode(); });
  bind({'q', GLFW_KEY_ESCAPE}, "q  Esc", "quit",
       [this](auto&) { glfwSetWindowShouldClose(window_, GLFW_TRUE); });
}

Screen::~Screen() {
  view_.reset();  // while there is a context
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Screen::bind(std::vector<int> keys, std::string names, std::string text,
                  std::function<void(const KeyPress&)> act) {
  bindings_.push_back({std::move(keys), std::move(names), std::move(text), std::move(act)});
}

void Screen::watch(const std::atomic<bool>& stop, const std::function<void(double)>& draw_picture) {
  using Clock = std::chrono::steady_clock;
  Clock::time_point last = Clock::now();
  while (glfwWindowShouldClose(window_) == GLFW_FALSE && !stop) {
    const Clock::time_point now = Clock::now();
    glfwPollEvents();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    for (const KeyPress& press : std::exchange(pressed_, {})) {
      for (const KeyBinding& binding : bindings_) {
        if (std::ranges::count(binding.keys, press.key) > 0) binding.act(press);
      }
    }
    draw_picture(std::chrono::duration<double>(now - last).count());
    last = now;
    std::this_thread::sleep_until(now + shortest_frame);
  }
}

Layout Screen::layout() const {
  const auto [width, height] = ImGui::GetIO().DisplaySize;
  const float plots = std::floor(std::clamp(0.36F * height, 160.0F, 420.0F)) + extras_.above_plots;
  const float panel = std::floor(std::clamp(0.24F * width, 300.0F, 420.0F));
  const float above = std::max(1.0F, height - plots);
  const float left = std::max(2.0F, width - panel);
  // At most half for the film, as far as its height fills it.
  const float film =
      std::floor(std::min(0.5F * left, static_cast<float>(extras_.film_aspect) * above));
  const float scene = left - film;
  return {{0.0F, 0.0F, scene, above},
          {scene, 0.0F, film, above},
          {left, 0.0F, panel, above},
          {0.0F, above, width, plots}};
}

void Screen::draw_scene(std::span<const render::SceneVector> vectors) {
  view_->draw(pixels_of(layout().scene), camera_.target(), camera_.camera(), vectors);
}

void Screen::draw_picture(const cv::Mat& picture, const Area& area) {
  const mjrRect pixels = pixels_of(area);
  cv::Mat image(pixels.height, pixels.width, CV_8UC3, render::rgb(0x101214));
  if (!picture.empty()) {
    const double scale = std::min(static_cast<double>(pixels.width) / picture.cols,
                                  static_cast<double>(pixels.height) / picture.rows);
    const int width = std::clamp(static_cast<int>(picture.cols * scale), 1, pixels.width);
    const int height = std::clamp(static_cast<int>(picture.rows * scale), 1, pixels.height);
    const cv::Rect place((image.cols - width) / 2, (image.rows - height) / 2, width, height);
    cv::resize(picture, image(place), place.size(), 0, 0, cv::INTER_AREA);
  }
  cv::flip(image, image, 0);  // OpenGL counts from below
  cv::cvtColor(image, image, cv::COLOR_BGR2RGB);
  view_->copy(image.data, pixels);
}

void Screen::draw_chips(const std::vector<Chip>& chips, const Area& area) {
  constexpr float height = 28.0F;
  constexpr float gap = 9.0F;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  ImVec2 at(area.left + gap, area.top + gap);
  for (const Chip& chip : chips) {
    const ImVec2 text = ImGui::CalcTextSize(chip.text.c_str());
    const float width = text.x + 2.0F * gap;
    if (at.x > area.left + gap && at.x + width > area.left + area.width) {  // in the next line
      at = {area.left + gap, at.y + height + gap};
    }
    list.AddRectFilled(at, {at.x + width, at.y + height}, colour_of(chip.colour));
    list.AddText({at.x + gap, at.y + 0.5F * (height - text.y)}, IM_COL32_WHITE, chip.text.c_str());
    at.x += width + gap;
  }
}

/// At the right edge of the scene, where the list hides no robot.
void Screen::draw_keys() const {
  const float right = layout().panel.left;
  ImGui::SetNextWindowPos({right, 0.0F}, ImGuiCond_Always, {1.0F, 0.0F});
  ImGui::SetNextWindowSizeConstraints({0.0F, 0.0F}, {right, ImGui::GetIO().DisplaySize.y});
  ImGui::Begin("keys", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, {6.0F, 0.0F});
  if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    for (const KeyBinding& binding : bindings_) {
      ImGui::TableNextColumn();
      ImGui::TextColored({0.0F, 0.45F, 0.7F, 1.0F}, "%s", binding.names.c_str());
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(binding.text.c_str());
    }
    ImGui::EndTable();
  }
  ImGui::PopStyleVar();
  ImGui::End();
}

void Screen::draw_widgets() {
  if (shows_keys_) draw_keys();
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Screen::show() { glfwSwapBuffers(window_); }

bool Screen::has_mouse() const {
  const ImGuiIO& io = ImGui::GetIO();
  return !io.WantCaptureMouse && io.MousePos.x < layout().scene.width;
}

bool Screen::has_mouse_on_robot() const {
  const Area scene = layout().scene;
  const ImVec2 at = ImGui::GetIO().MousePos;
  return has_mouse() && view_->robot_at(pixels_of(scene), (at.x - scene.left) / scene.width,
                                        1.0F - (at.y - scene.top) / scene.height);
}

void Screen::move_camera() {
  if (!has_mouse()) return;
  const ImGuiIO& io = ImGui::GetIO();
  camera_.approach(io.MouseWheel);
  if (std::max(io.MouseDownDuration[0], io.MouseDownDuration[1]) > 0.0F) {
    camera_.turn(io.MouseDelta.x, io.MouseDelta.y);
  }
}

Eigen::Vector3d Screen::motion_of(const Eigen::Vector3d& point) const {
  const ImVec2 moved = ImGui::GetIO().MouseDelta;
  return view_->motion_of(pixels_of(layout().scene), point,
                          {moved.x * pixel_scale(), -moved.y * pixel_scale()});
}

}  // namespace touchdown::viewer
