#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "estimator/kernel_density.hpp"
#include "estimator/measurement_model.hpp"

namespace touchdown {

/// What bandwidths and axes follow from, of torques that come one by one.
struct TorqueSurvey {
  std::size_t count = 0;
  TorqueSample mean;
  TorqueSample squares;  ///< sums of the squared differences from the mean
  TorqueSample lowest;
  TorqueSample highest;

  void add(const TorqueSample& sample) noexcept;
};

/// `fit_measurement_model` for logs of any length, in memory that does not grow with them: samples
/// are shown twice, first to find bandwidths and axes, then to be added to the densities. The
/// result is the same up to rounding.
class MeasurementFit {
 public:
  explicit MeasurementFit(const MeasurementFitConfig& config) : config_(config) {}

  /// First time. Throws InputError for a sample that is not finite.
  void survey(bool contact, const TorqueSample& sample);

  /// Between both. Throws InputError for fewer than two samples of either class, or samples that
  /// are all equal without a floor under the bandwidth.
  void prepare();

  /// Second time, the same samples in any order.
  void add(bool contact, const TorqueSample& sample);

  /// After both.
  [[nodiscard]] MeasurementModel model();

  [[nodiscard]] std::size_t count(bool contact) const noexcept { return of(contact).survey.count; }
  /// After `prepare` (N·m).
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

  MeasurementFitConfig config_;
  std::array<Class, 2> class_;
  Axis knee_;
  Axis wheel_;
};

}  // namespace touchdown
