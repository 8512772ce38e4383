#include "simulators/tyres.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchdown::simulators {

/// The longest steps up to a limit that divide the control step.
static void shorten(StepSizes& steps, double longest_us) {
  for (std::int64_t count = steps.control_us / steps.physics_us; count <= steps.control_us;
       ++count) {
    if (steps.control_us % count != 0) continue;
    steps.physics_us = steps.control_us / count;
    if (static_cast<double>(steps.physics_us) <= longest_us) break;
  }
}

SimulatorOptions with_steps_for_tyres(SimulatorOptions options, const models::RobotModel& model) {
  if (model.tyre.law == models::Tyre::Law::engine) return options;
  constexpr double largest_angle = 0.37;  // rad
  double lightest = std::numeric_limits<double>::infinity();
  for (const int tyre : model.tyre_geom) {
    lightest = std::min(lightest, model.mj->body_mass[model.mj->geom_bodyid[tyre]]);
  }
  // Bullet's damper is reduced by step · stiffness (bullet_world.cpp), and must not push.
  const double longest_us =
      1e6 * std::min(largest_angle * std::sqrt(lightest / model.tyre.stiffness),
                     model.tyre.damping / model.tyre.stiffness);
  shorten(options.steps, longest_us);
  return options;
}

SimulatorOptions with_half_steps(SimulatorOptions options, const models::RobotModel& model) {
  options = with_steps_for_tyres(options, model);
  shorten(options.steps, 0.5 * static_cast<double>(options.steps.physics_us));
  return options;
}

std::optional<std::size_t> wheel_of_tyre(const models::RobotModel& robot, int geom) {
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    const std::vector<int>& strips = robot.tyre_strips[wheel];
    if (std::find(strips.begin(), strips.end(), geom) != strips.end()) return wheel;
  }
  return std::nullopt;
}

/// Whether two contacts press the same strip in about the same direction.
static bool is_same_direction(const TyreContact& a, const TyreContact& b) {
  constexpr double cosine = 0.7;  // of 45°
  return a.strip == b.strip && a.normal.dot(b.normal) > cosine;
}

std::vector<bool> counted_contacts(const std::vector<TyreContact>& contacts) {
  std::vector<bool> count(contacts.size(), true);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    for (std::size_t j = 0; j < i && count[i]; ++j) {
      if (!count[j] || !is_same_direction(contacts[i], contacts[j])) continue;
      count[contacts[i].depth > contacts[j].depth ? j : i] = false;
    }
  }
  return count;
}

}  // namespace touchdown::simulators
