#include "viewer/screen/live_plots.hpp"

#include <algorithm>
#include <utility>

#include "render/palette.hpp"

namespace touchdown::viewer {

namespace {

constexpr render::StripWindow window = {.seconds = 6.0, .present = 0.98, .tiles = 8};
constexpr float acceleration_range = 20.0F;  // m/s²

}  // namespace

unsigned estimator_colour(std::size_t i) { return render::line_colour(i + 1); }

LivePlots::LivePlots(std::size_t estimators, double period, double weight) : period_(period) {
  const auto torque_range = static_cast<float>(std::max(1.0, 0.06 * weight));  // N·m
  for (const char* const title : {"P(contact), left", "P(contact), right"}) {
    render::StripRow row{.title = title, .curves = {}, .wheels_in_contact = {}, .period = period};
    for (std::size_t i = estimators; i-- > 0;) {                         // the first one on top
      row.curves.push_back({"", render::rgb(estimator_colour(i)), {}});  // named in the panel
    }
    rows_.push_back(std::move(row));
  }
  rows_.push_back(
      {.title = "torque (N·m)",
       .low = -torque_range,
       .high = torque_range,
       .curves = {{"wheel", render::rgb(0x009e73), {}}, {"knee", render::rgb(0xb0304f), {}}},
       .wheels_in_contact = {},
       .period = period});
  rows_.push_back({.title = "acceleration (m/s²)",
                   .low = -acceleration_range,
                   .high = acceleration_range,
                   .curves = {{"vertical", render::rgb(0x7b3fb0), {}}},
                   .wheels_in_contact = {},
                   .period = period});
}

double LivePlots::end() const {
  return period_ * static_cast<double>(std::max<std::size_t>(count_, 1) - 1);
}

void LivePlots::append(const std::vector<LiveSample>& samples) {
  if (samples.empty()) return;
  const auto row = [&](std::size_t i) -> render::StripRow& {
    return strip_ ? strip_->growing_row(i, end()) : rows_[i];
  };
  for (const LiveSample& sample : samples) {
    for (std::size_t wheel = 0; wheel < 2; ++wheel) {
      render::StripRow& beliefs = row(wheel);
      beliefs.wheels_in_contact.push_back(sample.contact[wheel] ? 2 : 0);
      for (std::size_t i = 0; i < sample.p_contact.size(); ++i) {
        beliefs.curves[beliefs.curves.size() - 1 - i].values.push_back(sample.p_contact[i][wheel]);
      }
    }
    row(2).curves[0].values.push_back(sample.wheel_torque);
    row(2).curves[1].values.push_back(sample.knee_torque);
    row(3).curves[0].values.push_back(sample.acceleration);
    ++count_;
  }
}

const cv::Mat& LivePlots::draw(int width, int height) {
  if (!strip_ || image_.cols != width || image_.rows != height) {
    if (strip_) rows_ = strip_->rows();
    strip_ = std::make_unique<render::SignalStrip>(std::move(rows_), width, height, window);
    image_.create(height, width, CV_8UC3);
  }
  strip_->draw(image_, end());
  return image_;
}

}  // namespace touchdown::viewer
