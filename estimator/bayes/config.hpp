#pragma once

#include "estimator/bayes/measurement_fit.hpp"
#include "estimator/bayes/transition_model.hpp"
#include "estimator/signal_guard.hpp"
#include "estimator/torque_channel.hpp"

namespace touchdown {

struct MeasurementConfig {
  /// What m_t is made of, when fitting and when estimating.
  TorqueConfig torque;
  /// How the densities are fitted.
  MeasurementFitConfig fit;
  /// Added to P(m_t | S_t = C) and to P(m_t | S_t = ¬C) at every step.
  double contact_floor = 0.0;
  double no_contact_floor = 0.0;

  bool operator==(const MeasurementConfig&) const = default;
};

/// Everything that can be chosen about the filter, seen whole. Start from a named configuration.
struct BayesFilterConfig {
  /// Rate at which `update` is called (Hz).
  double sample_rate = 1000.0;
  /// Eq. (4) to (6).
  MeasurementConfig measurement;
  /// Eq. (7) to (13).
  TransitionConfig transition;
  /// What to do with signals that cannot be used.
  SignalGuardConfig guard;
  /// A wheel is said to be in contact when P(contact) is at least this.
  double threshold = 0.8;

  /// The paper to the letter.
  static BayesFilterConfig paper();
  /// The paper with the other reading of its power, the root mean square: with the mean square, an
  /// acceleration of 2.8 m/s² is an even chance to switch, with this one of 8 m/s².
  static BayesFilterConfig paper_rms();
  /// As the authors' robot code does it.
  static BayesFilterConfig reference();
  /// The reference with what sensor noise requires: a floor under the bandwidths, the median of the
  /// power spectrum, a transition matrix whose rows sum to one, absolute low-passed torques on a
  /// grid that covers all samples.
  static BayesFilterConfig robust();

  bool operator==(const BayesFilterConfig&) const = default;
};

/// Throws InputError for a threshold outside [0, 1], a negative floor or a negative low-pass.
void check_measurement_config(const MeasurementConfig& config, double threshold);

}  // namespace touchdown
