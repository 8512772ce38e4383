#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/drops/drops.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/signals/run_signals.hpp"
#include "recordings/recording.hpp"

namespace touchdown::experiments {

/// What the transition model makes of one vertical acceleration, Eq. (9) to (13) of the paper; one
/// entry per step of the window but for `spectrum`.
struct SpectrumTrace {
  std::vector<double> acceleration;      ///< γ^z (m/s²)
  std::vector<double> power;             ///< m²/s⁴
  std::vector<double> median_frequency;  ///< Hz
  std::vector<double> p_switch;          ///< P(S_t ≠ S_t−1)
  std::vector<double> p_takeoff;         ///< P(S_t = ¬C | S_t−1 = C)
  std::vector<double> p_landing;         ///< P(S_t = C | S_t−1 = ¬C)
  /// A_t(ω) = |â_t(ω)|²/N, Eq. (10), of the window that ends at every `spectrum_stride`-th step,
  /// by step, then frequency bin (m²/s⁴).
  std::vector<std::vector<double>> spectrum;
};

inline constexpr std::size_t spectrum_stride = 2;

/// Torques of the left leg as its servos report them (N·m).
struct TorqueTrace {
  std::vector<double> knee, wheel;
};

/// P(the left wheel touches) by one estimator.
struct BeliefTrace {
  std::string estimator;
  std::string title;  ///< what people call it
  std::vector<double> p_contact;
};

/// What one noise setting makes of the drop.
struct NoisyDrop {
  noise::NoiseCell noise;
  TorqueTrace torque;
  /// log (P(m_t | C) / P(m_t | ¬C)) of the left leg, Eq. (6), by `DropDetail::transition_of`; NaN
  /// if the experiment has not fitted it.
  std::vector<double> torque_evidence;
  SpectrumTrace spectrum;
  std::vector<BeliefTrace> beliefs;
};

/// Everything about one drop that the paper's Fig. 5 shows of one: columns with one entry per step.
struct DropDetail {
  std::string simulator;
  std::optional<double> at = {};      ///< the moment that was asked for instead of a drop (s)
  std::vector<double> time;           ///< since takeoff, or that moment (s)
  std::vector<double> height;         ///< of the base, above that at takeoff (m)
  std::vector<std::uint8_t> contact;  ///< of the left wheel, by its label
  double bin_width = 0.0;             ///< of the spectra (Hz)
  std::string transition_of;          ///< whose models the spectra and the evidence belong to
  double switch_power = 0.0;          ///< where P(switch) is one half (m²/s⁴)
  TorqueTrace torque;                 ///< noiseless
  SpectrumTrace spectrum;             ///< noiseless
  std::vector<NoisyDrop> noisy;       ///< by noise setting
};

/// Lets the estimators listen to the whole run through the noise that the study hears, with the
/// models that were fitted in the same engine, and keeps the window around the drop. The spectra
/// are those of the first estimator that has a transition model, or of `robust`. `recording` is the
/// run that `run` was heard from.
/// Errors: `InputError` when the run has no such drop.
DropDetail drop_detail(const Experiment& experiment, const DetailConfig& config,
                       const recordings::Recording& recording, const RunSignals& run,
                       const FittedModels& models);

}  // namespace touchdown::experiments
