#include "viewer/screen/screen.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace touchdown::viewer {

Layout layout_of(int width, int height) {
  const int plots = std::clamp(height * 36 / 100, 160, 420);
  const int panel = std::clamp(width * 24 / 100, 220, 420);
  const int above = std::max(1, height - plots);
  const int scene = std::max(1, width - panel);
  return {{0, 0, scene, above}, {scene, 0, panel, above}, {0, above, width, plots}};
}

Chip contact_chip(int wheels) {
  if (wheels == 0) return {"IN THE AIR", orange};
  return wheels == 1 ? Chip{"ON ONE WHEEL", brown} : Chip{"ON THE GROUND", green};
}

mjrRect Screen::viewport() const {
  const Area scene = layout().scene;
  return {scene.left, window_.height() - scene.top - scene.height, scene.width, scene.height};
}

void Screen::draw_scene(std::span<const render::SceneVector> vectors) {
  view_->draw(viewport(), camera_.target(), camera_.camera(), vectors);
}

void Screen::draw(const cv::Mat& picture, int left, int top) {
  cv::Mat flipped;
  cv::flip(picture, flipped, 0);  // OpenGL counts from below
  cv::cvtColor(flipped, upload_, cv::COLOR_BGR2RGB);
  view_->copy(upload_.data,
              {left, window_.height() - top - picture.rows, picture.cols, picture.rows});
}

void Screen::draw_at_edge(const cv::Mat& picture) {
  const Area scene = layout().scene;
  draw(picture, scene.left + std::max(0, scene.width - picture.cols),
       scene.top + std::max(0, (scene.height - picture.rows) / 2));
}

void Screen::draw_chips(const std::vector<Chip>& chips) {
  constexpr int height = 28;
  int left = height / 2;
  for (const Chip& chip : chips) {
    const int width = pen_.width(chip.text, height / 2) + 2 * (2 * height / 5);
    cv::Mat image(height, width, CV_8UC3);
    pen_.chip(image, chip.text, 0, 0, height, render::rgb(chip.colour));
    draw(image, left, height / 2);
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
