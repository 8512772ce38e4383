#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "estimator/bayes/measurement_model.hpp"

namespace touchdown {

class KernelDensityGrid;

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

/// Fits f_C and f_¬C, Eq. (5) and (6), each with its own bandwidth, to samples of both legs from
/// `TorqueChannel`.
/// Throws InputError for fewer than two samples of either class and for samples that are not
/// finite.
MeasurementModel fit_measurement_model(std::span<const TorqueSample> contact,
                                       std::span<const TorqueSample> no_contact,
                                       const MeasurementFitConfig& config);

/// Statistics of torque samples that arrive one by one, for bandwidths and axes.
struct TorqueSurvey {
  std::size_t count = 0;
  TorqueSample mean;
  TorqueSample squares;  ///< sums of the squared differences from the mean
  TorqueSample lowest;
  TorqueSample highest;

  void add(const TorqueSample& sample) noexcept;
};

/// `fit_measurement_model` for logs of any length in constant memory. The caller passes all samples
/// twice: first for bandwidths and axes, then for the densities. The result is the same up to
/// rounding.
class MeasurementFit {
 public:
  explicit MeasurementFit(const MeasurementFitConfig& config);
  ~MeasurementFit();

  /// First pass. Throws InputError for a sample that is not finite.
  void survey(bool contact, const TorqueSample& sample);

  /// Between the passes. Throws InputError for fewer than two samples of either class, or samples
  /// that are all equal without a floor under the bandwidth.
  void prepare();

  /// Second pass: the same samples in any order.
  void add(bool contact, const TorqueSample& sample);

  /// After both passes.
  [[nodiscard]] MeasurementModel model();

  [[nodiscard]] std::size_t count(bool contact) const noexcept { return of(contact).survey.count; }
  /// Valid after `prepare` (N·m).
  [[nodiscard]] TorqueBandwidth bandwidth(bool contact) const noexcept {
    return of(contact).bandwidth;
  }

 private:
  struct Class {
    TorqueSurvey survey;
    TorqueBandwidth bandwidth;
    std::unique_ptr<KernelDensityGrid> density;
  };
  [[nodiscard]] Class& of(bool contact) noexcept { return class_[contact ? 1 : 0]; }
  [[nodiscard]] const Class& of(bool contact) const noexcept { return class_[contact ? 1 : 0]; }
  void choose_bandwidth(Class& of_class, const char* name) const;
  [[nodiscard]] Axis axis_for(const std::optional<std::pair<double, double>>& range, int count,
                              double TorqueSample::*torque, double TorqueBandwidth::*width) const;
  /// Makes axes and empty densities from bandwidths and survey.
  void make_grids();
  friend MeasurementModel fit_measurement_model(std::span<const TorqueSample>,
                                                std::span<const TorqueSample>,
                                                const MeasurementFitConfig&);

  MeasurementFitConfig config_;
  std::array<Class, 2> class_;
  Axis knee_;
  Axis wheel_;
};

}  // namespace touchdown
