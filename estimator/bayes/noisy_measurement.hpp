#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "estimator/bayes/config.hpp"
#include "estimator/bayes/measurement_model.hpp"
#include "estimator/numerics/noise_estimate.hpp"
#include "estimator/signal_guard.hpp"
#include "estimator/signals.hpp"

namespace touchdown {

/// The measurement model under white noise of the torque sensors. The sum of a torque and of
/// independent noise has the density of the torque, widened by that of the noise. This class holds
/// the widened densities for a few levels of noise at the knee and at the wheel. Copies share them.
class NoisyMeasurement {
 public:
  /// Widens the densities if the configuration follows the noise; otherwise they stay as fitted.
  NoisyMeasurement(MeasurementModel model, const MeasurementConfig& config);

  /// The model for one pair of levels (`TorqueNoise`).
  [[nodiscard]] const MeasurementModel& at(std::size_t level) const noexcept {
    return (*models_)[level];
  }
  /// The model as fitted.
  [[nodiscard]] const MeasurementModel& fitted() const noexcept { return models_->front(); }

 private:
  std::shared_ptr<const std::vector<MeasurementModel>> models_;
};

/// The levels of a noise estimate, and the level of the densities that is nearest to each.
struct TorqueNoiseLevels {
  TorqueNoiseLevels(const MeasurementConfig& config, double sample_rate);

  /// The index of a model of `NoisyMeasurement`, from the levels of the knees' and wheels'
  /// estimates.
  [[nodiscard]] std::size_t model(std::size_t knee, std::size_t wheel) const noexcept {
    return nearest[knee] * densities + nearest[wheel];
  }

  NoiseEstimate<2> estimate;         ///< a fresh one of two joints with the same noise
  double warm_up;                    ///< of the estimate, in updates
  std::size_t densities;             ///< per joint
  std::vector<std::size_t> nearest;  ///< of the densities, by level of the estimate
};

/// Estimates the noise of both knees' and both wheels' torques while the filter runs, and selects
/// the densities that are nearest to it.
class TorqueNoise {
 public:
  TorqueNoise(const MeasurementConfig& config, double sample_rate);

  void reset() noexcept;
  /// The next torques do not follow the last ones. The estimates stay.
  void reset_signals() noexcept;

  /// Takes the reported torques of both legs (N·m), left and right. Values that are not finite are
  /// skipped. Returns the level, the index of a model of `NoisyMeasurement`.
  std::size_t update(const std::array<double, 2>& knee,
                     const std::array<double, 2>& wheel) noexcept {
    if (follows_) {
      knee_.update(knee);
      wheel_.update(wheel);
    }
    return level();
  }
  /// The same for the legs with usable torques.
  std::size_t update(const Signals& signals, const SignalGuardConfig& guard) noexcept;

  [[nodiscard]] std::size_t level() const noexcept {
    return follows_ ? levels_.model(knee_.level(), wheel_.level()) : 0;
  }

 private:
  bool follows_;
  TorqueNoiseLevels levels_;
  NoiseEstimate<2> knee_;
  NoiseEstimate<2> wheel_;
};

}  // namespace touchdown
