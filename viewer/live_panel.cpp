#include "viewer/live_panel.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "scenarios/scenario.hpp"
#include "viewer/screen/live_plots.hpp"

namespace touchdown::viewer {

namespace {

PanelLine slider_line(const LiveControls& controls, LiveNumber number, std::string text,
                      std::string value) {
  return {.text = std::move(text),
          .value = std::move(value),
          .slider = PanelSlider{static_cast<int>(number),
                                controls.value(number) / range_of(number).most}};
}

void add_estimators(const LiveControls& controls, const LiveState& state,
                    std::vector<PanelLine>& lines) {
  lines.push_back({.text = "contact: left and right wheel", .value = "accuracy", .heading = true});
  lines.push_back({.text = "ground truth", .badges = ContactBadges{state.contact}});
  for (std::size_t i = 0; i < controls.estimators().size(); ++i) {
    PanelLine line{.text = controls.estimators()[i], .colour = render::rgb(estimator_colour(i))};
    if (i < state.estimates.size()) {
      const LiveState::Estimate& estimate = state.estimates[i];
      line.value = fmt::format("{:5.1f} %", 100.0 * estimate.accuracy);
      line.badges = ContactBadges{
          estimate.contact,
          {estimate.contact[0] != state.contact[0], estimate.contact[1] != state.contact[1]}};
    }
    lines.push_back(std::move(line));
  }
}

/// The estimators that decide wrongly now; empty without one.
std::string wrong_estimators(const LiveControls& controls, const LiveState& state) {
  std::string names;
  for (std::size_t i = 0; i < std::min(state.estimates.size(), controls.estimators().size()); ++i) {
    if (state.estimates[i].contact == state.contact) continue;
    names += (names.empty() ? "" : ", ") + controls.estimators()[i];
  }
  return names;
}

}  // namespace

std::vector<Chip> live_chips(const LiveControls& controls, const LiveState& state) {
  const double time = state.period * static_cast<double>(state.steps);
  std::vector<Chip> chips = {{controls.scene().engine == "mujoco" ? "MuJoCo" : "Bullet", dark},
                             {fmt::format("t = {:.2f} s", time), grey},
                             contact_chip((state.contact[0] ? 1 : 0) + (state.contact[1] ? 1 : 0))};
  if (state.outcome) {
    chips.push_back({fmt::format("{}: r restarts", scenarios::outcome_text(*state.outcome)), red});
  } else if (controls.is_paused()) {
    chips.push_back({"PAUSED", dark});
  } else if (controls.speed() != 1.0) {
    chips.push_back({fmt::format("{:.3g}× speed", controls.speed()), dark});
  }
  const std::string wrong = wrong_estimators(controls, state);
  if (!wrong.empty() && state.steps > 0) chips.push_back({"wrong: " + wrong, red});
  return chips;
}

std::vector<PanelLine> live_panel(const LiveControls& controls, const LiveState& state) {
  std::vector<PanelLine> lines;
  add_estimators(controls, state, lines);
  lines.push_back({.text = "policy", .heading = true});
  const bool is_scenarios = controls.settings().contact_source == 0;
  lines.push_back({.text = is_scenarios ? "scenario's contact (o)" : "contact from (o)",
                   .value = controls.contact_source()});
  lines.push_back(slider_line(controls, LiveNumber::contact_delay, "  delayed by (b)",
                              fmt::format("{:.0f} ms", 1e3 * controls.settings().contact_delay)));
  lines.push_back({.text = "  received", .badges = ContactBadges{state.policy_contact}});
  lines.push_back({.text = "speed (↑ ↓)", .value = fmt::format("{:.1f} m/s", state.velocity)});
  lines.push_back({.text = "turn (← →)", .value = fmt::format("{:.1f} rad/s", state.yaw_rate)});
  lines.push_back({.text = "crouch (c)", .value = fmt::format("{:.1f} rad", state.hip)});
  lines.push_back({.text = "sensors", .heading = true});
  lines.push_back({.text = "profile (p)", .value = controls.sensors_name()});
  const noise::SensorNoise& noise = controls.settings().noise;
  lines.push_back(slider_line(controls, LiveNumber::torque_noise, "torque noise (t)",
                              fmt::format("{:.2f} N·m", noise.knee_torque)));
  lines.push_back(slider_line(controls, LiveNumber::acceleration_noise, "accelerometer noise (a)",
                              fmt::format("{:.0f} m/s²", noise.acceleration)));
  const LiveScene& scene = controls.scene();
  lines.push_back({.text = scene.run < 0
                               ? "no random draw (n)"
                               : fmt::format("seed {}, draw {} (n)", scene.seed, scene.run),
                   .value = state.rate > 0.0 ? fmt::format("{:.2f}× real time", state.rate) : "",
                   .heading = true});
  lines.push_back({.text = "h: all keys", .heading = true});
  return lines;
}

}  // namespace touchdown::viewer
