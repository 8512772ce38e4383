#include "scenarios/perturbation.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/fields.hpp"
#include "core/random.hpp"

namespace touchdown::scenarios {

namespace {

/// The draws of one entry of one script. Every script and quantity has its own stream. `perturbed`
/// leaves the upper half of the counter zero, so its streams differ from these. Append to the list
/// of streams, never renumber it.
class Draw {
 public:
  Draw(std::uint64_t seed, std::int64_t run, std::uint64_t entry)
      : seed_(seed), run_(static_cast<std::uint64_t>(run)), entry_(entry + 1) {}

  double between(std::uint64_t stream, const Range& range) const {
    return range.low + (range.high - range.low) * uniform01(seed_, run_, entry_ << 32U | stream);
  }

 private:
  std::uint64_t seed_, run_, entry_;
};

enum Stream : std::uint64_t {
  drive_hold,
  drive_velocity,
  drive_yaw_rate,
  drive_standing,
  lift_hold,
  lift_pause,
  lift_force,
  crouch_hold,
  crouch_hip
};

KeyNotes describe_range(Fields& fields, std::string_view key, Range& range, double low,
                        double high) {
  std::vector<double> ends = {range.low, range.high};
  const KeyNotes notes = fields.in_line(key, ends);
  fields.check(ends.size() == 2 && low <= ends[0] && ends[0] <= ends[1] && ends[1] <= high, key,
               fmt::format("expected [low, high] within {} to {}", low, high));
  range = {ends[0], ends[1]};
  return notes.type("list of low, high").range(range_text(low, high));
}

}  // namespace

static void describe(Fields& fields, RandomDrive& drive) {
  fields("velocity", drive.velocity, 0.0, 3.0).doc("m/s", "Half width of the velocity commands.");
  fields("yaw_rate", drive.yaw_rate, 0.0, 10.0)
      .doc("rad/s", "Half width of the yaw-rate commands.");
  fields("standing", drive.standing, 0.0, 1.0).doc("Share of commands to stand still.");
  describe_range(fields, "hold", drive.hold, 0.01, 1e4).doc("s", "How long each command lasts.");
  fields("start", drive.start, 0.0, 1e4).doc("s", "Time of the first command.");
}

static void describe(Fields& fields, RandomCrouches& crouches) {
  describe_range(fields, "hip", crouches.hip, -policies::largest_angle, policies::largest_angle)
      .doc("rad", "Hip angle.");
  fields("exponent", crouches.exponent, 0.1, 10.0)
      .doc("Exponent of the uniform draw; above 1 the low end is likelier.");
  describe_range(fields, "hold", crouches.hold, 0.01, 1e4)
      .doc("s", "How long each command lasts, motion included.");
  fields("rate", crouches.rate, 1e-3, 100.0).doc("rad/s", "Rate of the hip angle.");
  fields("start", crouches.start, 0.0, 1e4).doc("s", "Time of the first command.");
}

static void describe(Fields& fields, RandomLifts& lifts) {
  describe_range(fields, "force", lifts.force, 0.0, 1e4).doc("N", "Upward force.");
  describe_range(fields, "hold", lifts.hold, 0.001, 1e4).doc("s", "How long each lift lasts.");
  describe_range(fields, "pause", lifts.pause, 0.001, 1e4).doc("s", "Time between two lifts.");
  fields("start", lifts.start, 0.0, 1e4).doc("s", "Time of the first lift.");
  policies::describe_vector(fields, "point_in_base", lifts.point_in_base)
      .doc("m", "Point of action in the base frame.");
}

void describe(Fields& fields, Perturbation& perturbation) {
  fields("x", perturbation.x, 0.0, 10.0).doc("m", "Starting position along the course.");
  fields("y", perturbation.y, 0.0, 10.0).doc("m", "Starting position across the course.");
  fields("yaw", perturbation.yaw, 0.0, 3.2).doc("rad", "Starting heading.");
  fields("velocity", perturbation.velocity, 0.0, 2.0)
      .doc("m/s", "Every commanded velocity that is not zero.");
  fields("crouch", perturbation.crouch, 0.0, 1.0)
      .doc("rad",
           "Hip angle at the start, never within 0.03 of straight; the knee is proportional.");
  fields("mass_scale", perturbation.mass_scale, 0.0, 0.9).doc("Mass and inertia of every body.");
  fields("friction", perturbation.friction, 0.0, 2.0).doc("Friction of the terrain.");
  fields("servo_gain_scale", perturbation.servo_gain_scale, 0.0, 0.9)
      .doc("Position and velocity gains of the legs' servos.");
  fields("force_scale", perturbation.force_scale, 0.0, 1.0).doc("Every external force.");
  fields.if_set(perturbation.com_x != 0.0, "com_x", perturbation.com_x, 0.0, 0.5)
      .doc("m", "Centre of mass of the base body, forward.");
  fields.if_set(perturbation.com_z != 0.0, "com_z", perturbation.com_z, 0.0, 0.5)
      .doc("m", "Centre of mass of the base body, upward.");
  fields
      .if_set(perturbation.wheel_radius_scale != 0.0, "wheel_radius_scale",
              perturbation.wheel_radius_scale, 0.0, 0.5)
      .doc("Radius of both wheels.");
  fields
      .if_set(perturbation.actuator_friction_scale != 0.0, "actuator_friction_scale",
              perturbation.actuator_friction_scale, 0.0, 1.0)
      .doc("Friction of every joint.");
  fields
      .if_set(perturbation.torque_error != 0.0, "torque_error", perturbation.torque_error, 0.0, 0.5)
      .doc("Error of each servo's torque constant, independently.");
  fields.section("drive", perturbation.drive)
      .doc("Random drive commands instead of the scenario's own.");
  fields.section("crouching", perturbation.crouching)
      .doc("Random crouches instead of the scenario's own.");
  fields.section("lift", perturbation.lift).doc("Random lifts besides the scenario's own forces.");
}

policies::VelocityScript random_drive(const RandomDrive& drive, double duration, std::uint64_t seed,
                                      std::int64_t run) {
  policies::VelocityScript script;
  double time = drive.start;
  for (std::uint64_t entry = 0; time < duration; ++entry) {
    const Draw draw(seed, run, entry);
    const bool stands = draw.between(drive_standing, {0.0, 1.0}) < drive.standing;
    const double velocity = draw.between(drive_velocity, {-drive.velocity, drive.velocity});
    const double yaw_rate = draw.between(drive_yaw_rate, {-drive.yaw_rate, drive.yaw_rate});
    script.push_back({time, stands ? 0.0 : velocity, stands ? 0.0 : yaw_rate});
    time += draw.between(drive_hold, drive.hold);
  }
  return script;
}

policies::CrouchScript random_crouches(const RandomCrouches& crouches, double duration,
                                       std::uint64_t seed, std::int64_t run) {
  policies::CrouchScript script;
  const auto& [low, high] = crouches.hip;
  double time = crouches.start;
  for (std::uint64_t entry = 0; time < duration; ++entry) {
    const Draw draw(seed, run, entry);
    const double share = std::pow(draw.between(crouch_hip, {0.0, 1.0}), crouches.exponent);
    script.push_back({time, low + (high - low) * share, crouches.rate});
    time += draw.between(crouch_hold, crouches.hold);
  }
  return script;
}

policies::ForceScript random_lifts(const RandomLifts& lifts, double duration, std::uint64_t seed,
                                   std::int64_t run) {
  policies::ForceScript script;
  double time = lifts.start;
  for (std::uint64_t entry = 0; time < duration; ++entry) {
    const Draw draw(seed, run, entry);
    const double hold = draw.between(lift_hold, lifts.hold);
    const Eigen::Vector3d force(0.0, 0.0, draw.between(lift_force, lifts.force));
    script.push_back(
        {.time = time, .duration = hold, .force = force, .point_in_base = lifts.point_in_base});
    time += hold + draw.between(lift_pause, lifts.pause);
  }
  return script;
}

}  // namespace touchdown::scenarios
