#include "render/film/strip.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "render/palette.hpp"

namespace touchdown::render {

namespace {

void add_wheels(StripRow& row, const std::string& label, const Colour& colour,
                const std::array<std::vector<float>, models::wheel_count>& values) {
  if (!values[1].empty()) row.curves.push_back({label, colour, values[1], false});
  if (!values[0].empty()) row.curves.push_back({label, colour, values[0], true});
}

StripRow empty_row(const std::string& title, const VideoSource& source,
                   const std::vector<std::uint8_t>& contact = {}) {
  return {.title = title,
          .curves = {},
          .wheels_in_contact = contact,
          .period = source.recording.period()};
}

StripRow contact_row(const VideoSource& source, const std::vector<std::uint8_t>& contact,
                     const std::string& title) {
  StripRow row = empty_row(title, source, contact);
  for (std::size_t i = source.beliefs.size(); i-- > 0;) {  // the first one on top
    const BeliefTrack& belief = source.beliefs[i];
    add_wheels(row, belief.name, rgb(belief.colour), belief.p_contact);
  }
  return row;
}

StripRow transition_row(const VideoSource& source, const std::vector<std::uint8_t>& contact) {
  StripRow row = empty_row("takeoff / landing", source, contact);
  for (const BeliefTrack& belief : source.beliefs) {
    if (belief.p_takeoff[0].empty() && belief.p_landing[0].empty()) continue;
    add_wheels(row, "takeoff", rgb(0xd55e00), belief.p_takeoff);
    add_wheels(row, "landing", rgb(0x7b3fb0), belief.p_landing);
    break;
  }
  return row;
}

std::vector<float> torque(const logs::Recording& recording, models::Servo servo) {
  std::vector<float> values;
  values.reserve(recording.steps());
  for (const models::Observation& observation : recording.observation) {
    values.push_back(static_cast<float>(observation.servo[models::index(servo)].torque));
  }
  return values;
}

/// Sets a range that is symmetric about zero and fits all torques (N·m). Peaks far beyond usual
/// torques, as of a broken sensor, are clipped, and the title has the largest.
void fit_range(StripRow& row) {
  std::vector<float> sizes;
  for (const StripCurve& curve : row.curves) {
    for (const float value : curve.values) {
      if (std::isfinite(value)) sizes.push_back(std::abs(value));
    }
  }
  float range = 1.0f;
  if (!sizes.empty()) {
    const auto at = sizes.begin() + static_cast<std::ptrdiff_t>((sizes.size() - 1) * 95 / 100);
    std::nth_element(sizes.begin(), at, sizes.end());
    const float most = *std::ranges::max_element(sizes);
    range = std::max(1.0f, std::min(most, 10.0f * *at));
    if (most > range) row.title += fmt::format(", peaks {:.2g}", most);
  }
  row.low = -range;
  row.high = range;
}

constexpr int smallest_names = 7;  ///< height of letters (px)
constexpr double seconds = 4.0;    ///< that the strip shows
constexpr double present = 0.75;   ///< position of the present in them

}  // namespace

std::vector<StripRow> strip_rows(const std::vector<VideoSource>& sources,
                                 const scoring::LabelConfig& labels) {
  std::vector<StripRow> rows;
  if (sources.size() == 1) {
    const VideoSource& source = sources.front();
    const auto contact = wheels_in_contact(source.recording, labels);
    const bool has_beliefs = !source.beliefs.empty();
    if (has_beliefs) rows.push_back(contact_row(source, contact, "contact probability"));
    StripRow transitions = transition_row(source, contact);
    if (!transitions.curves.empty()) rows.push_back(std::move(transitions));
    StripRow torques =
        empty_row("torque (N·m)", source, has_beliefs ? std::vector<std::uint8_t>{} : contact);
    torques.curves.push_back(
        {"wheel", rgb(0x009e73), torque(source.recording, models::Servo::left_wheel)});
    torques.curves.push_back(
        {"knee", rgb(0xb0304f), torque(source.recording, models::Servo::left_knee)});
    fit_range(torques);
    rows.push_back(std::move(torques));
    return rows;
  }
  for (const VideoSource& source : sources) {
    const std::string what = source.beliefs.empty() ? "true contact" : "P(contact)";
    rows.push_back(contact_row(source, wheels_in_contact(source.recording, labels),
                               sources.size() > 2 ? what  // the curve has the name
                                                  : what + ", " + label_of(source)));
  }
  if (sources.size() > 2) return rows;
  StripRow knees = empty_row("knee torque (N·m)", sources.front());
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const logs::Recording& recording = sources[i].recording;
    std::vector<float> values = torque(recording, models::Servo::left_knee);
    if (recording.period() != knees.period) {  // resample to the first recording's rows
      std::vector<float> resampled;
      for (std::size_t k = 0;; ++k) {
        const auto from =
            static_cast<std::size_t>(static_cast<double>(k) * knees.period / recording.period());
        if (from >= values.size()) break;
        resampled.push_back(values[from]);
      }
      values = std::move(resampled);
    }
    knees.curves.push_back({label_of(sources[i]), rgb(line_colour(i + 1)), std::move(values)});
  }
  fit_range(knees);
  rows.push_back(std::move(knees));
  return rows;
}

SignalStrip::SignalStrip(std::vector<StripRow> rows, int width, int height)
    : rows_(std::move(rows)),
      width_(width),
      height_(height),
      letters_(std::max(std::clamp(height * 11 / 150, 8, 13), height * 13 / 220)),
      names_(letters_ - 1),
      left_(3 * letters_),
      right_(width - letters_) {
  while (!place_rows() && names_ > smallest_names) --names_;
  background_ = cv::Mat(height_, width_, CV_8UC3, strip_paper);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    draw_ticks(i);
    draw_names(i);
  }
  const int plot_width = right_ - left_;
  const int now = static_cast<int>(std::lround(present * plot_width));
  fog_ = cv::Mat(height_, plot_width - now, CV_8UC3, strip_paper);
  plots_ = std::make_unique<StripPlots>(rows_, areas_, plot_width, height_, seconds);
}

bool SignalStrip::is_in_legend_before(std::size_t i, const StripCurve& curve) const {
  return std::any_of(
      rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(i), [&](const StripRow& row) {
        return std::any_of(row.curves.begin(), row.curves.end(), [&](const StripCurve& before) {
          return before.label == curve.label && before.colour == curve.colour;
        });
      });
}

std::vector<SignalStrip::Name> SignalStrip::names_of(std::size_t i) const {
  int x = left_ + pen_.width(rows_[i].title, letters_) + letters_;
  int line = 0;
  std::vector<Name> names;
  // The first curve of the legend is drawn last.
  for (auto curve = rows_[i].curves.rbegin(); curve != rows_[i].curves.rend(); ++curve) {
    if (!curve->emphasis || curve->label.empty() || is_in_legend_before(i, *curve)) continue;
    if (x > left_ && x + legend_width(*curve) > right_) {
      x = left_;
      ++line;
    }
    names.push_back({&*curve, x, line});
    x += legend_width(*curve) + letters_ / 2;
  }
  return names;
}

/// Plots of one height below their titles and legends. False if the strip is too low; its rows are
/// then cut off.
bool SignalStrip::place_rows() {
  line_ = names_ + std::max(2, names_ / 4);
  const int gap = std::max(4, height_ / 40);
  const int count = std::max<int>(1, static_cast<int>(rows_.size()));
  int rest = height_ - gap * (count + 1);
  headers_.clear();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    headers_.push_back(header_of(i));
    rest -= headers_.back() + 2 * letters_;
  }
  areas_.clear();
  int bottom = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const int top = bottom + gap + headers_[i];
    bottom = std::min(height_ - 2, top + 2 * letters_ + std::max(0, rest) / count);
    areas_.push_back({std::min(top, bottom - 2), bottom});
  }
  return rest >= 0;
}

/// The height of title and legend above a plot (px).
int SignalStrip::header_of(std::size_t i) const {
  const std::vector<Name> names = names_of(i);
  return letters_ + letters_ / 2 + (names.empty() ? 0 : names.back().line * line_);
}

void SignalStrip::draw_ticks(std::size_t i) {
  const int letters = letters_ - 1;
  for (const double share : {0.0, 1.0}) {
    const float value = rows_[i].low + static_cast<float>(share) * (rows_[i].high - rows_[i].low);
    const std::string tick = fmt::format("{:.2g}", value);
    const auto at = static_cast<int>(plot_y(rows_[i], areas_[i], value));
    pen_.write(background_, tick, left_ - 5 - pen_.width(tick, letters),
               at - (share > 0.0 ? letters_ / 4 : letters_ * 3 / 4), letters, rgb(0x5c636e));
  }
}

int SignalStrip::legend_width(const StripCurve& curve) const {
  return letters_ * 5 / 4 + 4 + pen_.width(curve.label, names_) + letters_ / 2;
}

void SignalStrip::draw_legend(const StripCurve& curve, int x, int top) {
  const int dash = letters_ * 5 / 4;
  const int middle = top + letters_ / 2 + 1;
  cv::line(background_, {x, middle}, {x + dash, middle}, curve.colour, 3, cv::LINE_AA);
  pen_.write(background_, curve.label, x + dash + 4, top, names_, curve.colour);
}

void SignalStrip::draw_names(std::size_t i) {
  const int top = areas_[i].top - headers_[i];
  pen_.write(background_, rows_[i].title, left_, top, letters_, strip_ink);
  for (const Name& name : names_of(i)) draw_legend(*name.curve, name.x, top + name.line * line_);
}

void SignalStrip::draw(cv::Mat image, double time) {
  background_.copyTo(image);
  cv::Mat plots = image.colRange(left_, right_);
  plots_->copy_window(time - present * seconds, plots);
  for (std::size_t i = 0; i < rows_.size(); ++i) {  // names stand on the plots' paper, above them
    const int bottom = areas_[i].top;
    const int top = std::max(0, bottom - headers_[i]);
    background_.rowRange(top, bottom).copyTo(image.rowRange(top, bottom));
  }
  const int now = plots.cols - fog_.cols;
  for (const PlotArea& area : areas_) {
    cv::Mat future = plots(cv::Rect(now, area.top, fog_.cols, area.bottom - area.top));
    cv::addWeighted(future, 0.4, fog_.rowRange(area.top, area.bottom), 0.6, 0.0, future);
  }
  cv::line(plots, {now, areas_.front().top - 2}, {now, areas_.back().bottom + 2}, strip_ink, 1);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (const StripCurve& curve : rows_[i].curves) {
      const double k = time / rows_[i].period;
      if (!curve.emphasis || k < 0 || k >= static_cast<double>(curve.values.size())) continue;
      const float value = curve.values[static_cast<std::size_t>(k)];
      if (!std::isfinite(value)) continue;
      const auto y =
          static_cast<int>(std::lround(plot_y(rows_[i], areas_[i], value) * (1 << subpixel_bits)));
      cv::circle(plots, {now << subpixel_bits, y}, 4 << subpixel_bits, curve.colour, cv::FILLED,
                 cv::LINE_AA, subpixel_bits);
    }
  }
}

}  // namespace touchdown::render
