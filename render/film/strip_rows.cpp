#include "render/film/strip_rows.hpp"

#include <algorithm>
#include <cmath>

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

std::vector<float> torque(const recordings::Recording& recording, models::Servo servo) {
  std::vector<float> values;
  values.reserve(recording.steps());
  for (const models::Observation& observation : recording.observation) {
    values.push_back(static_cast<float>(observation.servo[models::index(servo)].torque));
  }
  return values;
}

/// Sets a range that is symmetric about zero and fits usual torques (N·m). Peaks at landings are
/// clipped: they would flatten everything else.
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
    range = std::max(1.0f, 2.0f * *at);
  }
  row.low = -range;
  row.high = range;
}

}  // namespace

std::vector<StripRow> strip_rows(const std::vector<VideoSource>& sources,
                                 const scoring::LabelConfig& labels) {
  std::vector<StripRow> rows;
  if (sources.size() == 1) {
    const VideoSource& source = sources.front();
    const auto contact = wheels_in_contact(source.recording, labels);
    rows.push_back(contact_row(source, contact, "contact probability"));
    rows.push_back(transition_row(source, contact));
    StripRow torques = empty_row("torque (N·m)", source);
    torques.curves.push_back(
        {"wheel", rgb(0x009e73), torque(source.recording, models::Servo::left_wheel)});
    torques.curves.push_back(
        {"knee", rgb(0xb0304f), torque(source.recording, models::Servo::left_knee)});
    fit_range(torques);
    rows.push_back(std::move(torques));
    return rows;
  }
  for (const VideoSource& source : sources) {
    rows.push_back(contact_row(source, wheels_in_contact(source.recording, labels),
                               sources.size() > 2 ? "P(contact)"  // the curve has the name
                                                  : "P(contact), " + label_of(source)));
  }
  if (sources.size() > 2) return rows;
  StripRow knees = empty_row("knee torque (N·m)", sources.front());
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const recordings::Recording& recording = sources[i].recording;
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

}  // namespace touchdown::render
