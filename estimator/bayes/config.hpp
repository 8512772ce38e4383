#pragma once

#include <array>
#include <type_traits>

#include "estimator/bayes/measurement_fit.hpp"
#include "estimator/bayes/transition_model.hpp"
#include "estimator/members.hpp"
#include "estimator/signal_guard.hpp"
#include "estimator/torque_channel.hpp"

namespace touchdown {

/// Whether and how the densities follow white noise of the torque sensors.
struct TorqueNoiseConfig {
  /// Widens the densities by the noise that the filter estimates while it runs. Otherwise they stay
  /// as fitted.
  bool is_followed = false;
  /// The densities are widened by this share of the noise that the torques' low-pass leaves. The
  /// filter takes low-passed samples for independent, so densities narrower than the noise do best.
  double share = 0.7;
  /// Range of the estimated noise (N·m), before the torques' low-pass.
  double floor = 0.02;
  double ceiling = 6.4;
  /// Relative change of the estimate at each step.
  double gain = 0.01;
  /// During this time after the start (s) the estimate moves faster, as 1/time.
  double warm_up = 0.1;

  bool operator==(const TorqueNoiseConfig&) const = default;
};

struct MeasurementConfig {
  /// How m_t follows from the torques, in the fit and in the estimator.
  TorqueConfig torque;
  /// How the densities are fitted.
  MeasurementFitConfig fit;
  /// How they follow the sensors' noise.
  TorqueNoiseConfig noise;
  /// Added to P(m_t | S_t = C) and to P(m_t | S_t = ¬C) at every step.
  double contact_floor = 0.0;
  double no_contact_floor = 0.0;

  bool operator==(const MeasurementConfig&) const = default;
};

/// All settings of the filter. Start from a named configuration.
struct BayesFilterConfig {
  /// Rate at which `update` is called (Hz).
  double sample_rate = 1000.0;
  /// Eq. (4) to (6).
  MeasurementConfig measurement;
  /// Eq. (7) to (13).
  TransitionConfig transition;
  /// Treatment of unusable signals.
  SignalGuardConfig guard;
  /// The filter decides for contact when P(contact) is at least this.
  double threshold = 0.8;

  /// The paper to the letter.
  static BayesFilterConfig paper();
  /// The paper with the other reading of its power, the root mean square. P(switch) is one half at
  /// an acceleration of 8 m/s², with the mean square at 2.8 m/s².
  static BayesFilterConfig paper_rms();
  /// The authors' robot code.
  static BayesFilterConfig reference();
  /// The reference with the changes that sensor noise requires: a floor under the bandwidths, the
  /// median of the power spectrum, transition rows that sum to one, and absolute low-passed torques
  /// on a grid that covers all samples.
  static BayesFilterConfig robust();

  bool operator==(const BayesFilterConfig&) const = default;
};

inline constexpr std::array sign_names = {"absolute", "mirrored"};  // of `TorqueSign`
static_assert(static_cast<int>(TorqueSign::mirrored) == 1);

void members(auto& visit, MembersOf<BayesFilterConfig> auto& config) {
  auto& measurement = config.measurement;
  visit.choose("torque.sign", sign_names, measurement.torque.sign);
  visit("torque.low_pass", measurement.torque.low_pass, Range::not_negative);
  visit("contact_floor", measurement.contact_floor, Range::not_negative);
  visit("no_contact_floor", measurement.no_contact_floor, Range::not_negative);
  // Models with densities that stay as fitted do not have these keys.
  auto& noise = measurement.noise;
  if (!std::is_const_v<std::remove_reference_t<decltype(noise)>> || noise.is_followed) {
    visit("noise.is_followed", noise.is_followed);
    visit("noise.share", noise.share, Range::not_negative);
    visit("noise.floor", noise.floor, Range::not_negative);
    visit("noise.ceiling", noise.ceiling, Range::not_negative);
    visit("noise.gain", noise.gain, Range::share);
    visit("noise.warm_up", noise.warm_up, Range::not_negative);
  }
  members(visit, config.transition);
  visit("threshold", config.threshold, Range::share);
  members(visit, config.guard);
}

}  // namespace touchdown
