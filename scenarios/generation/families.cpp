#include "scenarios/generation/families.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/fingerprint.hpp"
#include "core/random.hpp"
#include "core/yaml.hpp"
#include "scenarios/scenario.hpp"

namespace touchdown::scenarios {

namespace {

constexpr double highest_lift = 0.8;  // m: higher than that a hand does not carry a robot
constexpr double longest_run = 90.0;  // s

/// How far a robot flies that leaves the end of a ramp at this velocity (m).
double flight_length(const models::Ramp& ramp, double velocity) {
  const double angle = ramp.incline * std::numbers::pi / 180.0;
  const double up = velocity * std::sin(angle);
  const double time = (up + std::sqrt(up * up + 2.0 * scene_gravity * ramp.rise)) / scene_gravity;
  return velocity * std::cos(angle) * time;
}

/// Whether a jump off a ramp ends behind the level ground that follows it.
bool overshoots(const Scenario& scenario) {
  const std::vector<models::TerrainPiece>& pieces = scenario.terrain.pieces;
  const double velocity = scenario.velocity.empty() ? 0.0 : scenario.velocity.back().velocity;
  for (std::size_t i = 0; i + 2 < pieces.size(); ++i) {
    const auto* ramp = std::get_if<models::Ramp>(&pieces[i]);
    const auto* step = std::get_if<models::Step>(&pieces[i + 1]);
    const auto* landing = std::get_if<models::Flat>(&pieces[i + 2]);
    constexpr double room = 0.5;  // m: to come to rest on the wheels before the next piece
    if (ramp && step && landing && ramp->rise > 0.0 &&
        flight_length(*ramp, velocity) + room > landing->length) {
      return true;
    }
  }
  return false;
}

// On level ground, where only the robot itself acts.

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
  scenario.clip_crouches = true;
  scenario.terrain.friction = draws.between("friction", 0.4, 1.0);
  scenario.end.duration = time;
  scenario.perturbation = {.yaw = 0.5, .mass_scale = 0.1, .servo_gain_scale = 0.2};
  return scenario;
}

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
    scenario.clip_crouches = true;
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

Scenario draw_bending_hops(const Draws& draws) {
  Scenario scenario;
  double time = 1.0;
  double hip = 0.45;
  const auto bend_to = [&](double target, double rate, double pause) {
    scenario.crouch.push_back({.time = time, .hip = target, .rate = rate});
    time += std::abs(target - hip) / rate + pause;
    hip = target;
  };
  const int count = draws.whole("count", 2, 4);
  for (int i = 0; i < count; ++i) {
    const Draws hop = draws.of("hop", i);
    bend_to(hop.between("low", 0.65, 0.85), hop.log_between("bend_rate", 0.8, 3.0),
            hop.between("low_hold", 0.3, 1.5));
    const int springs = hop.whole("springs", 1, 2);
    for (int k = 0; k < springs; ++k) {
      const Draws spring = hop.of("spring", k);
      bend_to(spring.between("high", 0.2, 0.45), spring.between("extend_rate", 6.0, 9.0),
              spring.log_between("in_air", 0.01, 0.15));
      bend_to(spring.between("bent", 0.4, 0.75), spring.log_between("retract_rate", 2.0, 7.0),
              spring.log_between("landed", 0.05, 0.4));
    }
    time += hop.between("pause", 0.8, 1.6);
  }
  scenario.clip_crouches = true;
  scenario.terrain.width = 20.0;
  scenario.terrain.friction = draws.between("friction", 0.4, 1.0);
  scenario.end.duration = time;
  scenario.perturbation = {.yaw = 0.5, .mass_scale = 0.1, .servo_gain_scale = 0.2};
  if (draws.happens("drives", 0.6)) {
    scenario.perturbation.drive = RandomDrive{.velocity = draws.between("velocity", 0.0, 0.25),
                                              .yaw_rate = draws.between("yaw_rate", 0.0, 1.0)};
  }
  return scenario;
}

// A scene of another family, with a difference.

/// Draws a scene of one of the families that are listed before this one.
Scenario of_family_before(std::string_view name, const Draws& draws) {
  const std::vector<Family>& all = families();
  const auto end = std::ranges::find(all, name, &Family::name);
  const int last = static_cast<int>(end - all.begin()) - 1;
  return all[static_cast<std::size_t>(draws.whole("family", 0, last))].draw(draws.of("scene", 0));
}

/// A payload that estimators do not know of.
Scenario draw_payloads(const Draws& draws) {
  Scenario scenario = of_family_before("payloads", draws);
  scenario.deviations.payload = draws.between("payload", 0.5, 3.5);
  scenario.deviations.com_z = draws.between("com_z", 0.0, 0.05);
  return scenario;
}

Scenario on_tyres(const Draws& draws, const models::Tyre& tyre) {
  Scenario scenario = of_family_before("soft_tyres", draws);
  scenario.tyre = tyre;
  scenario.forces_for_mass = written_mass;
  return scenario;
}

Scenario draw_soft_tyres(const Draws& draws) {
  return on_tyres(draws, spring_tyre(draws.log_between("stiffness", 8e3, 3e4),
                                     draws.between("damping_ratio", 0.12, 0.4)));
}

Scenario draw_hard_tyres(const Draws& draws) {
  return on_tyres(draws, spring_tyre(draws.log_between("stiffness", 3e4, 1e5),
                                     draws.between("damping_ratio", 0.4, 0.8)));
}

}  // namespace

models::Tyre spring_tyre(double stiffness, double damping_ratio) {
  return {.law = models::Tyre::Law::spring_damper,
          .stiffness = stiffness,
          .damping = 2.0 * damping_ratio * std::sqrt(stiffness * 0.5 * written_mass)};
}

double greatest_height(const policies::ForceScript& forces, double mass, double duration) {
  constexpr double step = 1e-3;  // s
  double height = 0.0;
  double velocity = 0.0;
  double greatest = 0.0;
  for (double time = 0.0; time < duration; time += step) {
    double up = -mass * scene_gravity;
    for (const policies::TimedForce& force : forces) up += force.share_at(time) * force.force.z();
    velocity += step * up / mass;
    height += step * velocity;
    if (height <= 0.0) height = velocity = 0.0;
    greatest = std::max(greatest, height);
  }
  return greatest;
}

std::optional<std::string> objection_to(const Scenario& scenario) {
  if (scenario.end.duration > longest_run) {
    return fmt::format("it lasts {:.0f} s, more than {:.0f}", scenario.end.duration, longest_run);
  }
  if (scenario.forces_for_mass) {
    const double mass = *scenario.forces_for_mass * scenario.mass_scale;
    const double height = greatest_height(scenario.forces, mass, scenario.end.duration);
    if (height > highest_lift) {
      return fmt::format("it lifts the robot by {:.2f} m, more than {}", height, highest_lift);
    }
  }
  if (overshoots(scenario)) return "a jump ends behind the level ground that follows it";
  return std::nullopt;
}

Draws::Draws(std::uint64_t seed, std::string_view family, std::uint64_t number,
             std::uint64_t attempt)
    : seed_(seed),
      place_(Fingerprint()
                 .add(family)
                 .add(std::to_string(number))
                 .add(std::to_string(attempt))
                 .value()) {}

double Draws::share(std::string_view quantity) const {
  return uniform01(seed_, place_, Fingerprint().add(quantity).value());
}

double Draws::between(std::string_view quantity, double low, double high) const {
  return low + (high - low) * share(quantity);
}

double Draws::log_between(std::string_view quantity, double low, double high) const {
  return low * std::pow(high / low, share(quantity));
}

int Draws::whole(std::string_view quantity, int low, int high) const {
  return low + static_cast<int>(std::floor((high - low + 1) * share(quantity)));
}

bool Draws::happens(std::string_view quantity, double probability) const {
  return share(quantity) < probability;
}

Draws Draws::of(std::string_view list, int index) const {
  return {seed_,
          Fingerprint().add(std::to_string(place_)).add(list).add(std::to_string(index)).value()};
}

const std::vector<Family>& families() {
  static const std::vector<Family> all = {
      {"stairs", "Down a flight of stairs.", draw_stairs},
      {"kerbs", "Up a ramp and off its end with one wheel.", draw_kerbs},
      {"ridges", "Along a washboard, with both wheels or one.", draw_ridges},
      {"ramps", "Up a ramp, along its top, and down a step or another ramp.", draw_ramps},
      {"ramp_jumps", "Up a ramp and off its end at speed.", draw_ramp_jumps},
      {"courses", "Stairs, ramps and ridges in a row.", draw_courses},
      {"lifts", "Lifted by forces that appear and vanish at once.", draw_lifts},
      {"slow_lifts", "Lifted by forces that grow and fade over 0.2 to 10 s.", draw_slow_lifts},
      {"put_downs", "Lifted and put down while the wheels spin.", draw_put_downs},
      {"hangs", "On a rope, never in contact.", draw_hangs},
      {"pushes", "Pushed from all sides while it stands.", draw_pushes},
      {"push_offs", "Pushed over the edge of a platform, straight or at an angle.", draw_push_offs},
      {"drives", "Random drive commands on level ground, always in contact.", draw_drives},
      {"squats", "Legs that bend quickly: the torso falls.", draw_squats},
      {"hops", "Legs that extend quickly: small hops.", draw_hops},
      {"bending_hops", "Hops with legs that bend in flight, while driving and turning.",
       draw_bending_hops},
      {"light_stands", "A hand or a rope carries part of the weight for seconds.",
       draw_light_stands},
      {"rockings", "Rocked from wheel to wheel.", draw_rockings},
      {"rubble", "Over small blocks, with bent legs.", draw_rubble},
      {"payloads", "A scene of another family with a payload.", draw_payloads},
      {"soft_tyres", "A scene of another family on soft rubber, which bounces.", draw_soft_tyres},
      {"hard_tyres", "The same on hard tyres, which do not.", draw_hard_tyres},
  };
  return all;
}

const Family& random_scenes() {
  static const Family family = {"random_scenes", "Random commands and forces on random terrain.",
                                draw_random_scene};
  return family;
}

const Family& family_called(const std::string& name) {
  if (name == random_scenes().name) return random_scenes();
  std::vector<std::string> names = {random_scenes().name};
  for (const Family& family : families()) {
    if (family.name == name) return family;
    names.push_back(family.name);
  }
  throw InputError(
      fmt::format("there is no family of scenarios '{}'{}", name, did_you_mean(name, names)));
}

}  // namespace touchdown::scenarios
