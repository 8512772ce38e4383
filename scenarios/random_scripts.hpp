#pragma once

#include <cstdint>

#include "policies/force_script.hpp"
#include "policies/velocity_script.hpp"

namespace touchdown::scenarios {

/// A quantity drawn uniformly between two values; `[low, high]` in YAML.
struct Range {
  double low = 0.0;
  double high = 0.0;
};

/// Somebody playing with the sticks: random commands, each held for a while.
struct RandomDrive {
  double velocity = 0.5;    ///< half width (m/s)
  double yaw_rate = 0.5;    ///< half width (rad/s)
  double standing = 0.2;    ///< share of the commands that are to stand still
  Range hold = {1.0, 3.0};  ///< how long each command lasts (s)
  double start = 1.0;       ///< the first command's time (s)
};

/// Somebody lifting the robot and letting go: random upward forces with pauses between.
struct RandomLifts {
  Range force = {40.0, 60.0};  ///< N
  Range hold = {0.2, 0.6};     ///< how long each lift lasts (s)
  Range pause = {0.5, 1.5};    ///< how long the robot is left alone after it (s)
  double start = 1.0;          ///< the first lift's time (s)
  /// Where it is held, in the base frame (m).
  Eigen::Vector3d point_in_base = {0.0, 0.0, 0.06};
};

void describe(Fields& fields, RandomDrive& drive);
void describe(Fields& fields, RandomLifts& lifts);

/// The script of one run, until `duration` (s): a pure function of its arguments.
policies::VelocityScript random_drive(const RandomDrive& drive, double duration, std::uint64_t seed,
                                      std::int64_t run);
policies::ForceScript random_lifts(const RandomLifts& lifts, double duration, std::uint64_t seed,
                                   std::int64_t run);

}  // namespace touchdown::scenarios
