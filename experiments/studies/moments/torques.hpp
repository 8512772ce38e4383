#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

/// |torque| of a leg's knee and wheel (N·m) over steps without a gap, in one state of contact.
struct TorqueSegment {
  double period = 0.001;  ///< s
  std::vector<double> knee = {};
  std::vector<double> wheel = {};
};
using Joint = std::vector<double> TorqueSegment::*;

/// What was heard of both legs, by the wheel's state of contact: 0 in the air, 1 in contact.
using TorqueSegments = std::array<std::vector<TorqueSegment>, 2>;

/// Adds what a run has of it from `skip` (s) on.
void add_torques(const RunSignals& run, double skip, TorqueSegments& heard);

/// Where the quantiles of a distribution are read.
inline constexpr std::array<double, 3> quantiles = {0.5, 0.9, 0.99};

/// The distribution of one joint's |torque| over the steps of all stretches (N·m); NaN without any.
struct TorqueDistribution {
  std::int64_t samples = 0;
  double mean = 0.0;
  double deviation = 0.0;
  std::array<double, quantiles.size()> quantile = {};  ///< smallest values not exceeded so often
  double largest = 0.0;
  /// The first lag at which the autocorrelation is below 1/e (s), searched for in steps of 5 %, at
  /// least 1 ms; NaN if there is none up to 10 s.
  double autocorrelation_time = 0.0;
};
TorqueDistribution distribution_of(const std::vector<TorqueSegment>& segments, Joint joint);

/// Densities are counted in cells around the multiples of this (N·m): servos that report in steps
/// of .01 N·m fill every cell alike.
inline constexpr double torque_cell = 0.01;

/// The density of one joint's |torque| in its cells (1/(N·m)), from the one around 0, of which
/// there is but one half, to the largest torque's; empty without samples.
std::vector<double> density_of(const std::vector<TorqueSegment>& segments, Joint joint);

/// ∫ min(p, q) of the densities of (knee, wheel). NaN without samples.
double overlap(const std::vector<TorqueSegment>& a, const std::vector<TorqueSegment>& b);

}  // namespace touchdown::experiments
