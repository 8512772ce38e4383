#include "scenarios/generation/motion_families.hpp"

namespace touchdown::scenarios {

namespace {

/// Bends and extends the legs in turn: `bend` and `extend` draw the rate of the hip (rad/s).
template <typename Bend, typename Extend>
Scenario crouching(const Draws& draws, Bend bend, Extend extend) {
  Scenario scenario;
  double time = 1.0;
  const int count = draws.whole("count", 2, 4);
  for (int i = 0; i < count; ++i) {
    const Draws squat = draws.of("squat", i);
    scenario.crouch.push_back(
        {.time = time, .hip = squat.between("low", 0.75, 1.0), .rate = bend(squat)});
    time += squat.between("low_hold", 1.2, 2.0);
    scenario.crouch.push_back(
        {.time = time, .hip = squat.between("high", 0.2, 0.4), .rate = extend(squat)});
    time += squat.between("high_hold", 1.2, 2.0);
  }
  scenario.terrain.friction = draws.between("friction", 0.4, 1.0);
  scenario.end.duration = time;
  scenario.perturbation = {.yaw = 0.5, .mass_scale = 0.1, .servo_gain_scale = 0.2};
  return scenario;
}

}  // namespace

Scenario draw_drives(const Draws& draws) {
  Scenario scenario;
  scenario.terrain.width = 20.0;
  scenario.terrain.friction = draws.between("friction", 0.4, 1.0);
  scenario.end.duration = 20.0;
  Perturbation& varied = scenario.perturbation;
  varied.drive = RandomDrive{.velocity = draws.between("velocity", 0.2, 0.8),
                             .yaw_rate = draws.between("yaw_rate", 0.0, 1.0),
                             .standing = draws.between("standing", 0.1, 0.5),
                             .hold = {0.7, draws.between("longest", 1.5, 4.0)}};
  if (draws.happens("crouches", 0.5)) {
    varied.crouching = RandomCrouches{.hip = {0.2, draws.between("deepest", 0.5, 0.9)},
                                      .rate = draws.log_between("rate", 0.2, 1.0),
                                      .start = 1.0};
  }
  varied.yaw = 0.5;
  varied.crouch = 0.1;
  varied.mass_scale = 0.1;
  varied.servo_gain_scale = 0.2;
  return scenario;
}

Scenario draw_squats(const Draws& draws) {
  return crouching(
      draws, [](const Draws& squat) { return squat.log_between("bend_rate", 1.0, 6.5); },
      [](const Draws& squat) { return squat.log_between("extend_rate", 0.5, 1.5); });
}

Scenario draw_hops(const Draws& draws) {
  return crouching(
      draws, [](const Draws& squat) { return squat.log_between("bend_rate", 0.8, 2.0); },
      [](const Draws& squat) { return squat.between("extend_rate", 6.0, 9.0); });
}

}  // namespace touchdown::scenarios
