#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// The key `moments`: tables of torques next to the real robot's (docs/explanation/realism.md).
struct MomentsConfig {};

/// |torque| of a leg's knee and wheel (N·m) over consecutive steps in one contact state.
struct TorqueSegment {
  double period = 0.001;  ///< s
  std::vector<double> knee = {};
  std::vector<double> wheel = {};

  static auto members(auto& segment) {
    return std::tie(segment.period, segment.knee, segment.wheel);
  }
};

using Joint = std::vector<double> TorqueSegment::*;

/// Segments of both legs, by the wheel's contact state: 0 in the air, 1 in contact.
struct TorqueSegments : std::array<std::vector<TorqueSegment>, 2> {
  TorqueSegments& operator+=(const TorqueSegments& more);

  static auto members(auto& all) { return std::tie(all[0], all[1]); }
};

/// Adds a run's segments from `skip` (s) on. Steps without a record end a segment.
void add_torques(const RunSignals& run, double skip, TorqueSegments& all);

/// The probabilities of the quantiles of a distribution.
inline constexpr std::array<double, 3> quantiles = {0.5, 0.9, 0.99};

/// The distribution of one joint's |torque| over all segments (N·m); NaN without steps.
struct TorqueDistribution {
  std::int64_t samples = 0;
  double mean = NAN;
  double deviation = NAN;
  /// Smallest values with at least these probabilities.
  std::array<double, quantiles.size()> quantile = {NAN, NAN, NAN};
  double largest = NAN;
  /// The first lag with an autocorrelation below 1/e (s). The search goes in steps of 5 %, at least
  /// 1 ms, up to 10 s; NaN if there is none.
  double autocorrelation_time = NAN;
};
TorqueDistribution distribution_of(const std::vector<TorqueSegment>& segments, Joint joint);

/// Width of the cells of the densities (N·m), which are centred on its multiples. Servos that
/// report in steps of .01 N·m fill all cells evenly.
inline constexpr double torque_cell = 0.01;

/// The density of one joint's |torque| by cell (1/(N·m)), up to the largest torque. The first cell,
/// around 0, has half the width. Empty without samples.
std::vector<double> density_of(const std::vector<TorqueSegment>& segments, Joint joint);

/// The overlap ∫ min(p, q) of two densities of (knee, wheel). NaN without samples.
double overlap(const std::vector<TorqueSegment>& a, const std::vector<TorqueSegment>& b);

}  // namespace touchdown::experiments
