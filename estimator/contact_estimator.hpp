#pragma once

#include <array>
#include <limits>
#include <string_view>

#include "estimator/signal_bounds.hpp"
#include "estimator/signals.hpp"
#include "estimator/stopped_signals.hpp"

namespace touchdown {

/// The normal force of the ground on a wheel. NaN: the estimator has no leg geometry, signals are
/// not usable, or the force cannot be known, as on a straight leg without targets.
struct WheelLoad {
  double force = std::numeric_limits<double>::quiet_NaN();      ///< N
  double deviation = std::numeric_limits<double>::quiet_NaN();  ///< its standard deviation (N)
};

/// An estimator's belief about one wheel.
struct WheelBelief {
  /// P(S_t = C | m_0:t).
  double p_contact = 0.5;
  /// The estimator's own decision, from `p_contact` by its threshold (or hysteresis).
  bool contact = false;
  WheelLoad load = {};
};

/// Whether the last signals were usable and, if not, why.
enum class SignalStatus : int {
  good,     ///< the step was used unchanged
  invalid,  ///< a signal that is NaN or beyond its bound: the belief relaxed towards the prior
  gap,      ///< time jumped: the window restarted and the belief relaxed
  frozen,   ///< a sensor repeated itself to the bit: the belief relaxed
  /// The step was used, but without the load by the servos' laws: targets are missing, or gains are
  /// zero.
  degraded,
};

/// Whether the belief follows from the step's signals.
constexpr bool is_used(SignalStatus status) noexcept {
  return status == SignalStatus::good || status == SignalStatus::degraded;
}

/// "good", "invalid", "gap", "frozen", "degraded".
constexpr std::string_view to_text(SignalStatus status) noexcept {
  constexpr std::array<std::string_view, 5> texts = {"good", "invalid", "gap", "frozen",
                                                     "degraded"};
  const auto index = static_cast<std::size_t>(status);
  return index < texts.size() ? texts[index] : "";
}

/// An estimator's belief about the robot after one step.
struct Belief {
  /// Left wheel, right wheel.
  std::array<WheelBelief, 2> wheel;
  /// P(at least one wheel is in contact).
  double p_any_wheel = 0.5;
  /// P(both wheels are in contact).
  double p_both_wheels = 0.5;
  SignalStatus status = SignalStatus::good;
  /// The first signal of the step that is NaN, beyond its bound, or stopped. The status stays good
  /// if the estimator does not use this signal.
  SignalIndex unusable = SignalIndex::none;
};

/// Sets the robot's probabilities from the wheels'. The wheels are taken to be independent of each
/// other, so their probabilities multiply.
inline void multiply_wheels(Belief& belief) noexcept {
  const double left = belief.wheel[0].p_contact;
  const double right = belief.wheel[1].p_contact;
  belief.p_both_wheels = left * right;
  belief.p_any_wheel = left + (1.0 - left) * right;
}

/// Decides each wheel's contact by the threshold, then does as `multiply_wheels`.
inline void apply_threshold(Belief& belief, double threshold) noexcept {
  for (WheelBelief& wheel : belief.wheel) wheel.contact = wheel.p_contact >= threshold;
  multiply_wheels(belief);
}

/// The quantities behind a belief. NaN: the estimator does not compute this one.
struct Evidence {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  /// The last measurement of one wheel.
  struct Measurement {
    double contact_likelihood = unknown;     ///< P(m_t | S_t = C)
    double no_contact_likelihood = unknown;  ///< P(m_t | S_t = ¬C)
    double p_contact = unknown;              ///< from these two likelihoods alone
  };
  /// The last transition, common to both wheels.
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

/// The seam for contact estimators. The caller calls `update` once per time step. Neither `reset`
/// nor `update` allocates, locks or throws, so an estimator can run in a robot's control loop.
///
/// `update` checks all signals before any estimator gets them: a value beyond `SignalBounds`, or of
/// a signal that stopped (`StoppedSignals`), becomes NaN, which means a failed sensor. It checks
/// the belief, too: an estimator with probabilities outside [0, 1], or NaN, starts anew.
class ContactEstimator {
 public:
  virtual ~ContactEstimator() = default;

  /// Resets all state: the belief becomes the flat prior, P(S_0 = C) = 0.5.
  virtual void reset() noexcept = 0;

  /// Takes the signals of one step and returns the new belief, which is valid until the next call.
  const Belief& update(const Signals& signals) noexcept;

  /// Replaces the default bounds of the signals. Errors: as `check_members`.
  void limit_signals(const SignalBounds& bounds) { check_ = SignalCheck(bounds); }

  /// What the last belief was computed from, for logs and plots.
  [[nodiscard]] virtual Evidence evidence() const noexcept { return {}; }

 private:
  /// Takes signals that are NaN or within their bounds, and returns the new belief.
  virtual const Belief& estimate(const Signals& signals) noexcept = 0;

  const Belief& reported(const Belief& belief, SignalIndex unusable) noexcept;

  SignalCheck check_;
  StoppedSignals stopped_;
  Belief reported_;
};

}  // namespace touchdown
