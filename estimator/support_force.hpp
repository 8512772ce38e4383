#pragma once

#include <array>

#include "estimator/contact_estimator.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown {

/// One leg in its plane, hip to axle: two links whose centres of mass lie on the lines between the
/// joints. The values are Upkie's.
struct LegGeometry {
  double upper_length = 0.168;  ///< hip to knee (m)
  double lower_length = 0.175;  ///< knee to axle (m)
  double upper_mass = 0.69241;  ///< kg
  double lower_mass = 0.3954;   ///< kg
  double wheel_mass = 0.18455;  ///< kg, at the axle
  double upper_centre = 0.855;  ///< of mass, as a share of the length from the hip
  double lower_centre = 0.742;  ///< likewise, from the knee

  bool operator==(const LegGeometry&) const = default;
};

/// The vertical force of the ground on a leg's foot (N) that explains its torques, if the torso is
/// level and all of the leg accelerates upwards with `acceleration` (m/s², without gravity). With
/// the hip at q₁ and the knee at q₂ from straight, forward positive,
///
///     x = L₁ sin q₁ + L₂ sin(q₁ + q₂),   z = −L₁ cos q₁ − L₂ cos(q₁ + q₂),
///     Jᵀ F = −τ + Σ_i m_i (g + a) ∂z_i/∂q,
///
/// over the links and the wheel, solved for F = (F_x, F_z). `mirrored`: the joints' signs are those
/// of the right leg. Not finite where the knee is straight: a straight leg carries any load without
/// torques.
[[nodiscard]] double vertical_force(const LegGeometry& geometry, const LegSignals& leg,
                                    bool mirrored, double acceleration) noexcept;

struct SupportForceConfig {
  double sample_rate = 1000.0;  ///< at which `update` is called (Hz)
  LegGeometry geometry = {};
  double low_pass = 0.01;  ///< time constant of the low-pass of the force (s)
  double contact = 12.0;   ///< in contact from this force on (N) …
  double release = 6.0;    ///< … until it falls below this
  /// P(contact) = 1 / (1 + exp(−(force − middle) / width)), the middle between the two (N).
  double width = 1.5;
  SignalGuardConfig guard = {};
};

/// What teams with wheeled legs use: the normal force on each wheel from the torques of its leg,
/// through the leg's Jacobian, low-passed, with hysteresis. Needs the leg's geometry and nothing to
/// fit; sees one wheel as well as two, and lifts as well as falls. Weak where the leg is straight,
/// and as noisy as the torques are.
///
/// `update` never throws, allocates or locks, and never returns NaN. While the acceleration or a
/// leg's torques are not usable the belief relaxes to the prior and the status says why.
class SupportForce : public ContactEstimator {
 public:
  /// Throws InputError for a rate, width or length that is not positive, a negative time constant
  /// and thresholds out of order.
  explicit SupportForce(const SupportForceConfig& config = {});

  void reset() noexcept override;
  const Belief& update(const Signals& signals) noexcept override;

  /// The low-passed force on one wheel (N).
  [[nodiscard]] double force(Side side) const noexcept {
    return force_[static_cast<std::size_t>(side)];
  }

 private:
  SupportForceConfig config_;
  SignalGuard guard_;
  double gain_;
  std::array<double, 2> force_ = {};
  std::array<bool, 2> is_started_ = {};
  Belief belief_;
};

}  // namespace touchdown
