#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/scenario.hpp"

namespace touchdown::scenarios {

/// Gravity in every scene (m/s²).
inline constexpr double scene_gravity = 9.81;

/// Upkie's mass (kg), for which forces and tyres are written.
inline constexpr double written_mass = 5.33922;

/// Why a drawn scenario is rejected; empty if it is kept. The rules look at the scenario alone,
/// never at an estimator or a simulation: a robot that is lifted must not rise out of reach, and a
/// jump must end on the ground that is meant for it.
std::optional<std::string> objection_to(const Scenario& scenario);

/// The greatest height (m) that forces without a controller lift a robot of this mass (kg) to. It
/// leaves the ground when they exceed its weight.
double greatest_height(const policies::ForceScript& forces, double mass, double duration);

/// The random draws of one generated scenario. Every quantity has a stream of its own, keyed by its
/// name, so that one more quantity changes no other.
class Draws {
 public:
  /// `number` counts the scenarios of a family, `attempt` those that were rejected before.
  Draws(std::uint64_t seed, std::string_view family, std::uint64_t number, std::uint64_t attempt);

  /// Uniform between `low` and `high`.
  double between(std::string_view quantity, double low, double high) const;
  /// Uniform in the logarithm; for durations and rates, which cover decades. `low` > 0.
  double log_between(std::string_view quantity, double low, double high) const;
  /// A whole number from `low` to `high`, both included.
  int whole(std::string_view quantity, int low, int high) const;
  /// True with this probability.
  bool happens(std::string_view quantity, double probability) const;
  /// The draws of item `index` of a list, such as one piece of the terrain.
  Draws of(std::string_view list, int index) const;

 private:
  Draws(std::uint64_t seed, std::uint64_t place) : seed_(seed), place_(place) {}
  double share(std::string_view quantity) const;

  std::uint64_t seed_;
  std::uint64_t place_;  ///< hash of family, number, attempt and lists
};

/// One kind of generated scenario. A new family is a function and a line in families.cpp.
struct Family {
  std::string name;     ///< in experiments and file names
  std::string summary;  ///< one sentence
  /// Draws one scenario. What it leaves at its default is the robot's own or the engine's.
  Scenario (*draw)(const Draws& draws);
};

/// All families, in the order in which `generate` takes turns.
const std::vector<Family>& families();

/// Scenes without a plan: random commands and forces on random terrain. It takes no turns, so that
/// models that are fitted to the families can be tested on what no family draws.
const Family& random_scenes();

/// One of them or `random_scenes`. Errors: `InputError` for an unknown family, with the nearest
/// one.
const Family& family_called(const std::string& name);

Scenario draw_lifts(const Draws& draws);         ///< forces that appear and vanish at once
Scenario draw_slow_lifts(const Draws& draws);    ///< forces that grow and fade over .2 to 10 s
Scenario draw_put_downs(const Draws& draws);     ///< lifted and put down while the wheels spin
Scenario draw_hangs(const Draws& draws);         ///< on a rope, never in contact
Scenario draw_pushes(const Draws& draws);        ///< pushed while it stands, from all sides
Scenario draw_light_stands(const Draws& draws);  ///< a hand or a rope carries part of the weight
Scenario draw_rockings(const Draws& draws);      ///< rocked from wheel to wheel
Scenario draw_push_offs(const Draws& draws);     ///< pushed over the edge of a platform

Scenario draw_random_scene(const Draws& draws);

/// A tyre for Upkie's mass; `damping_ratio`: of half of Upkie on one tyre.
models::Tyre spring_tyre(double stiffness, double damping_ratio);

Scenario draw_stairs(const Draws& draws);      ///< down a flight of stairs
Scenario draw_kerbs(const Draws& draws);       ///< up a ramp and off its end with one wheel
Scenario draw_ridges(const Draws& draws);      ///< along a washboard, with both wheels or one
Scenario draw_ramps(const Draws& draws);       ///< up a ramp, along a top, down a step or a ramp
Scenario draw_ramp_jumps(const Draws& draws);  ///< up a ramp and off its end at speed
Scenario draw_courses(const Draws& draws);     ///< several of these pieces in a row
Scenario draw_rubble(const Draws& draws);      ///< over small blocks, with bent legs

}  // namespace touchdown::scenarios
