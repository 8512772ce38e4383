#pragma once

#include <array>
#include <limits>
#include <string_view>

#include "estimator/signals.hpp"

namespace touchdown {

/// What an estimator believes about one wheel.
struct WheelBelief {
  /// P(S_t = C | m_0:t).
  double p_contact = 0.5;
  /// The estimator's own decision, from `p_contact` by its threshold (or hysteresis).
  bool contact = false;
};

/// Whether the last signals could be used as they were.
enum class SignalStatus : int {
  good,     ///< the step was used as it came
  invalid,  ///< NaN or infinite input: the belief relaxed towards the prior
  gap,      ///< time jumped: the window was restarted and the belief relaxed
  frozen,   ///< a sensor repeats itself to the bit: the belief relaxed
};

/// "good", "invalid", "gap", "frozen".
constexpr std::string_view to_text(SignalStatus status) noexcept {
  switch (status) {
    case SignalStatus::good:
      return "good";
    case SignalStatus::invalid:
      return "invalid";
    case SignalStatus::gap:
      return "gap";
    case SignalStatus::frozen:
      return "frozen";
  }
  return "";
}

/// What an estimator believes about the robot after one step.
struct Belief {
  /// Left wheel, right wheel.
  std::array<WheelBelief, 2> wheel;
  /// P(at least one wheel is in contact).
  double p_any_wheel = 0.5;
  /// P(both wheels are in contact).
  double p_both_wheels = 0.5;
  SignalStatus status = SignalStatus::good;
};

/// From the wheels' probabilities to the robot's, for an estimator whose wheels are independent of
/// each other: then they multiply.
inline void multiply_wheels(Belief& belief) noexcept {
  const double left = belief.wheel[0].p_contact;
  const double right = belief.wheel[1].p_contact;
  belief.p_both_wheels = left * right;
  belief.p_any_wheel = left + (1.0 - left) * right;
}

/// As above, and to the wheels' decisions.
inline void apply_threshold(Belief& belief, double threshold) noexcept {
  for (WheelBelief& wheel : belief.wheel) wheel.contact = wheel.p_contact >= threshold;
  multiply_wheels(belief);
}

/// What a belief was computed from; NaN for what an estimator does not compute.
struct Evidence {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  /// Of the last measurement of one wheel.
  struct Measurement {
    double contact_likelihood = unknown;     ///< P(m_t | S_t = C)
    double no_contact_likelihood = unknown;  ///< P(m_t | S_t = ¬C)
    double p_contact = unknown;              ///< by these two alone
  };
  /// Of the last transition, common to both wheels.
  struct Transition {
    double power = unknown;                      ///< m²/s⁴
    double median_frequency = unknown;           ///< Hz
    double filtered_median_frequency = unknown;  ///< Hz
    double p_switch = unknown;                   ///< P(S_t ≠ S_t−1)
    double p_landing_if_switch = unknown;        ///< P(S_t = C | S_t ≠ S_t−1)
    double p_takeoff = unknown;                  ///< P(S_t = ¬C | S_t−1 = C)
    double p_landing = unknown;                  ///< P(S_t = C | S_t−1 = ¬C)
  };

  std::array<Measurement, 2> wheel;  ///< left, right
  Transition transition;
};

/// The seam for contact estimators. One call of `update` per time step; neither call allocates,
/// locks or throws, so that it can run in a robot's control loop.
class ContactEstimator {
 public:
  virtual ~ContactEstimator() = default;

  /// Forget everything: the belief is the flat prior, P(S_0 = C) = 0.5.
  virtual void reset() noexcept = 0;

  /// Take one step of signals and return the new belief.
  virtual const Belief& update(const Signals& signals) noexcept = 0;

  /// What the last belief was computed from, for those who log or draw it.
  [[nodiscard]] virtual Evidence evidence() const noexcept { return {}; }
};

}  // namespace touchdown
