#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "experiments/config/study_sections.hpp"
#include "noise/sensor_noise.hpp"

namespace touchdown::experiments {

/// A closed-loop scene with at most one varied quantity: a number of the scenario, the sensor
/// noise, or the delay of the contact signal.
struct ClosedLoopScene {
  std::string scenario;  ///< scenario file
  std::string key = {};  ///< of the scenario, dotted: `terrain.pieces.1.stairs.rise`; empty: none
  std::vector<double> values;                  ///< in the key's own unit
  std::vector<noise::NoiseCell> noise = {{}};  ///< in addition to the sensor model
  std::vector<double> delay = {0.0};           ///< s
};

/// The run that is filmed with several contact sources side by side.
struct ClosedLoopFilm {
  int scene = 0;                     ///< index of the scene, from 0
  int point = 0;                     ///< index of the varied value, from 0
  int run = 0;                       ///< index of the run
  std::string law;                   ///< one of the section's laws
  std::vector<std::string> contact;  ///< one to four contact sources
};

/// The section `closed_loop`: runs of a policy with contact from an estimator, from the ground
/// truth or without contact feedback (docs/explanation/closed_loop.md).
struct ClosedLoopConfig {
  std::vector<std::string> laws = {"soft_landing"};  ///< of policies
  std::vector<std::string> contact;  ///< contact sources: `truth`, `always`, estimators
  std::vector<ClosedLoopScene> scenes;
  int runs = 8;  ///< per scene and value, the same for all contact sources
  std::optional<ClosedLoopFilm> film = {};
};

/// The number of points of a scene's survival curve.
std::size_t points_of(const ClosedLoopScene& scene);

/// The section, its keys and its files.
StudySection closed_loop_section();

}  // namespace touchdown::experiments
