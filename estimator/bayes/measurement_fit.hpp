#pragma once

#include <array>
#include <optional>
#include <span>
#include <utility>

#include "estimator/bayes/measurement_model.hpp"

namespace touchdown {

/// Kernel widths along the two axes (N·m).
struct TorqueBandwidth {
  double knee = 0.0;
  double wheel = 0.0;

  bool operator==(const TorqueBandwidth&) const = default;
};

/// How a measurement model is fitted.
struct MeasurementFitConfig {
  /// Points of the grid along the knee's and the wheel's torque.
  int knee_count = 200;
  int wheel_count = 200;
  /// Ends of the axes (N·m): {lower, upper}. Without them the grid covers all samples and four
  /// bandwidths more (but nothing below zero if no sample is: absolute torques).
  std::optional<std::pair<double, double>> knee_range;
  std::optional<std::pair<double, double>> wheel_range;
  /// Lower bound of Scott's bandwidth (N·m). It stands for sensor noise that the fitted data lack.
  TorqueBandwidth bandwidth_floor;
  /// Use these bandwidths instead of Scott's rule (N·m).
  std::optional<TorqueBandwidth> bandwidth;

  bool operator==(const MeasurementFitConfig&) const = default;
};

/// A fitted measurement model, and the kernel widths of its densities: without contact, in contact.
struct MeasurementFit {
  MeasurementModel model;
  std::array<TorqueBandwidth, 2> bandwidth;
};

/// Fits f_C and f_¬C, Eq. (5) and (6), each with its own bandwidth, to samples of both legs from
/// `TorqueChannel`.
/// Throws InputError for fewer than two samples of either class, for samples that are not finite,
/// and for samples that are all equal without a floor under the bandwidth.
MeasurementFit fit_measurement(std::span<const TorqueSample> contact,
                               std::span<const TorqueSample> no_contact,
                               const MeasurementFitConfig& config);

/// The same without the bandwidths.
MeasurementModel fit_measurement_model(std::span<const TorqueSample> contact,
                                       std::span<const TorqueSample> no_contact,
                                       const MeasurementFitConfig& config);

}  // namespace touchdown
