#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "estimator/contact_estimator.hpp"
#include "estimator/force/load_estimate.hpp"
#include "estimator/numerics/noise_estimate.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown {

struct WheelLoadsConfig {
  double sample_rate = 1000.0;  ///< at which `update` is called (Hz)
  LegGeometry geometry = {};
  double low_pass = 0.01;  ///< time constant of the low-pass of the force (s)
  /// The force is limited to ± this (N). Near a straight knee it may be arbitrarily large, and one
  /// such value would stay in the low-pass for long.
  double largest = std::numeric_limits<double>::infinity();
  SignalGuardConfig guard = {};
};

/// Whether all signals behind a load are usable.
[[nodiscard]] inline bool has_load(const LegSignals& leg, const SignalGuardConfig& guard) noexcept {
  return is_torque(leg.hip.torque, guard) && is_torque(leg.knee.torque, guard) &&
         std::isfinite(leg.hip.position) && std::isfinite(leg.knee.position);
}

/// Whether lengths are positive and the time constant is not negative.
[[nodiscard]] bool is_sensible(const WheelLoadsConfig& config) noexcept;

/// The low-passed vertical force of the ground on each wheel, from usable signals. Estimators and
/// their fits use the same one.
class WheelLoads {
 public:
  /// The outcome of one step.
  struct Step {
    SignalStatus status = SignalStatus::good;
    double elapsed = 0.0;                  ///< since the previous step (s)
    bool restart = false;                  ///< the guard's verdict
    bool acceleration_good = true;         ///< the guard's verdict
    std::array<bool, 2> is_measured = {};  ///< whether this step has a force
    std::array<WheelLoad, 2> load = {};    ///< the normal forces, as beliefs have them
  };

  /// Throws InputError if `SignalGuard` does.
  explicit WheelLoads(const WheelLoadsConfig& config);

  void reset() noexcept;
  Step update(const Signals& signals) noexcept;

  /// As above, and updates the belief: it calls `decide(wheel, force)` for each wheel with a
  /// measured force. The probability of the others relaxes, and their last decision stands.
  template <typename Decide>
  void update(const Signals& signals, Belief& belief, const Decide& decide) noexcept {
    const Step step = update(signals);
    belief.status = step.status;
    for (std::size_t side = 0; side < 2; ++side) {
      WheelBelief& wheel = belief.wheel[side];
      wheel.load = step.load[side];
      if (step.is_measured[side]) {
        decide(wheel, force_[side]);
      } else {
        wheel.p_contact = relaxed(wheel.p_contact, step.elapsed);
      }
    }
    multiply_wheels(belief);
  }

  /// The last measured force on the left or the right wheel (N).
  [[nodiscard]] double force(std::size_t side) const noexcept { return force_[side]; }

  /// A belief after `elapsed` seconds without a measurement.
  [[nodiscard]] double relaxed(double p_contact, double elapsed) const noexcept {
    return guard_.relaxed(p_contact, elapsed);
  }

 private:
  WheelLoadsConfig config_;
  SignalGuard guard_;
  double gain_;
  std::array<double, 2> force_ = {};
  std::array<bool, 2> is_started_ = {};
  NoiseEstimate<2> torque_noise_;
  NoiseEstimate<1> acceleration_noise_;
  LoadEstimates load_estimates_;
};

}  // namespace touchdown
