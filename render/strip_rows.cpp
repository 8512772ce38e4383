#include <algorithm>
#include <cmath>

#include "render/frame_painter.hpp"

namespace touchdown {
namespace {

/// Colours that stay apart for colour-blind readers (Okabe and Ito), darkest first.
const std::array<unsigned, 6> palette = {0x0072b2, 0xd55e00, 0x009e73,
                                         0xcc79a7, 0xe69f00, 0x56b4e9};

Colour palette_colour(std::size_t i) { return rgb(palette[i % palette.size()]); }

void add_wheels(StripRow& row, const std::string& label, const Colour& colour,
                const std::array<std::vector<float>, wheel_count>& values) {
  if (!values[1].empty()) row.curves.push_back({label, colour, values[1], false});
  if (!values[0].empty()) row.curves.push_back({label, colour, values[0], true});
}

StripRow contact_row(const VideoSource& source, const std::vector<std::uint8_t>& contact,
                     const std::string& title) {
  StripRow row{.title = title,
               .curves = {},
               .wheels_in_contact = contact,
               .period = source.recording.period()};
  for (std::size_t i = source.beliefs.size(); i-- > 0;) {  // the first one on top
    add_wheels(row, source.beliefs[i].name, palette_colour(i), source.beliefs[i].p_contact);
  }
  return row;
}

StripRow transition_row(const VideoSource& source, const std::vector<std::uint8_t>& contact) {
  StripRow row{.title = "takeoff / landing",
               .curves = {},
               .wheels_in_contact = contact,
               .period = source.recording.period()};
  for (const BeliefTrack& belief : source.beliefs) {
    if (belief.p_takeoff[0].empty() && belief.p_landing[0].empty()) continue;
    add_wheels(row, "takeoff", rgb(0xd55e00), belief.p_takeoff);
    add_wheels(row, "landing", rgb(0x7b3fb0), belief.p_landing);
    break;
  }
  return row;
}

std::vector<float> torque(const Recording& recording, Servo servo) {
  std::vector<float> values;
  values.reserve(recording.steps());
  for (const Observation& observation : recording.observation) {
    values.push_back(static_cast<float>(observation.servo[index(servo)].torque));
  }
  return values;
}

/// Symmetric about zero and wide enough for everyday torques; landings run into the edge, or else
/// they would flatten everything (N·m).
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

std::vector<std::uint8_t> wheels_in_contact(const Recording& recording, const LabelConfig& labels) {
  if (recording.truth.size() < recording.steps()) return {};
  const auto wheels = contact_labels(recording, labels);
  std::vector<std::uint8_t> count(wheels[0].size());
  for (std::size_t k = 0; k < count.size(); ++k) {
    count[k] = static_cast<std::uint8_t>((wheels[0][k] != 0) + (wheels[1][k] != 0));
  }
  return count;
}

std::string engine_label(const Recording& recording) {
  const std::string& name = recording.info.simulator;
  if (name == "mujoco") return "MuJoCo";
  if (name == "bullet") return "Bullet";
  return name.empty() ? "robot log" : name;
}

std::vector<StripRow> strip_rows(const std::vector<VideoSource>& sources,
                                 const LabelConfig& labels) {
  std::vector<StripRow> rows;
  if (sources.size() == 1) {
    const VideoSource& source = sources.front();
    const auto contact = wheels_in_contact(source.recording, labels);
    rows.push_back(contact_row(source, contact, "contact probability"));
    rows.push_back(transition_row(source, contact));
    StripRow torques{.title = "torque (N·m)",
                     .curves = {},
                     .wheels_in_contact = {},
                     .period = source.recording.period()};
    torques.curves.push_back({"wheel", rgb(0x009e73), torque(source.recording, Servo::left_wheel)});
    torques.curves.push_back({"knee", rgb(0xb0304f), torque(source.recording, Servo::left_knee)});
    fit_range(torques);
    rows.push_back(std::move(torques));
    return rows;
  }
  for (const VideoSource& source : sources) {
    rows.push_back(contact_row(source, wheels_in_contact(source.recording, labels),
                               "P(contact), " + engine_label(source.recording)));
  }
  StripRow knees{.title = "knee torque (N·m)",
                 .curves = {},
                 .wheels_in_contact = {},
                 .period = sources.front().recording.period()};
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Recording& recording = sources[i].recording;
    std::vector<float> values = torque(recording, Servo::left_knee);
    if (recording.period() != knees.period) {  // onto the first recording's rows
      std::vector<float> resampled;
      for (std::size_t k = 0;; ++k) {
        const auto from =
            static_cast<std::size_t>(static_cast<double>(k) * knees.period / recording.period());
        if (from >= values.size()) break;
        resampled.push_back(values[from]);
      }
      values = std::move(resampled);
    }
    knees.curves.push_back({engine_label(recording), palette_colour(i), std::move(values)});
  }
  fit_range(knees);
  rows.push_back(std::move(knees));
  return rows;
}

}  // namespace touchdown
