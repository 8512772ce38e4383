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
#include "estimator/torque_channel.hpp"

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
  /// Eq. (5) and (6) by such a model, with the floors added.
  [[nodiscard]] Likelihoods likelihoods(const MeasurementModel& model,
                                        const TorqueSample& m) const noexcept {
    const Likelihoods p = model(m);
    return {p.contact + floor_.contact, p.no_contact + floor_.no_contact};
  }

 private:
  std::shared_ptr<const std::vector<MeasurementModel>> models_;
  Likelihoods floor_;
};

/// Estimates the noise of both knees' and both wheels' torques while the filter runs, and selects
/// the densities that are nearest to it. Copies share all but the estimates.
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

  [[nodiscard]] std::size_t level() const noexcept { return level(*this); }
  /// The level for the noise of these knees and of other wheels.
  [[nodiscard]] std::size_t level(const TorqueNoise& wheels) const noexcept {
    if (!follows_) return 0;
    return nearest_.get()[knee_.level()] * densities_ + nearest_.get()[wheels.wheel_.level()];
  }

 private:
  bool follows_;
  NoiseEstimate<2> knee_;
  NoiseEstimate<2> wheel_;
  std::size_t densities_;  ///< per joint
  /// The nearest of the densities, by level of an estimate.
  std::shared_ptr<const std::size_t[]> nearest_;
};

/// What the measurement model remembers of the torques of both legs.
struct TorqueMemory {
  TorqueMemory(const MeasurementConfig& config, double sample_rate)
      : noise(config, sample_rate),
        leg{TorqueChannel(config.torque, Side::left, sample_rate),
            TorqueChannel(config.torque, Side::right, sample_rate)} {}

  void reset() noexcept {
    noise.reset();
    for (TorqueChannel& torque : leg) torque.reset();
  }
  /// The next torques do not follow the last ones. The noise estimates stay.
  void reset_signals() noexcept {
    noise.reset_signals();
    for (TorqueChannel& torque : leg) torque.reset();
  }

  TorqueNoise noise;
  std::array<TorqueChannel, 2> leg;  ///< Eq. (4)
};

}  // namespace touchdown
