#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "estimator/contact_estimator.hpp"
#include "experiments/heard_run.hpp"

namespace touchdown {

using Make = std::function<std::unique_ptr<ContactEstimator>()>;
using Runs = std::vector<HeardRun>;

inline constexpr int study_noise_seeds = 3;

/// What changes between the sensors and the estimator besides noise.
struct Disturbance {
  double torque_bias = 0.0;  ///< N·m
  double torque_gain = 1.0;
  bool heavy_tails = false;   ///< noise of a tenth of the samples is four times as large
  std::size_t imu_delay = 0;  ///< steps, of accelerometer and gyroscope
};

/// Counts of one run; sums over noise seeds.
struct RunScore {
  Classification points;
  Classification away_from_events;  ///< without ±20 ms of takeoffs and ±5 ms of landings
  Classification but_light;         ///< without contact of less than 10 N
  TransitionCounts takeoff;
  TransitionCounts landing;
  Calibration calibration;
  std::vector<double> takeoff_latency;
  double seconds = 0.0;

  RunScore& operator+=(const RunScore& o) {
    points += o.points;
    away_from_events += o.away_from_events;
    but_light += o.but_light;
    takeoff += o.takeoff;
    landing += o.landing;
    calibration += o.calibration;
    takeoff_latency.insert(takeoff_latency.end(), o.takeoff_latency.begin(),
                           o.takeoff_latency.end());
    seconds += o.seconds;
    return *this;
  }
};

/// Lets a new estimator listen to every run under every noise seed: one score per run.
std::vector<RunScore> score_runs(const Make& make, const Runs& runs, const NoiseLevels& levels,
                                 const Disturbance& disturbance = {});

RunScore sum(const std::vector<RunScore>& scores);

/// Success of both wheels.
double success(const RunScore& score);

}  // namespace touchdown
