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

/// The transition model's response to one vertical acceleration, Eq. (9) to (13) of the paper. One
/// entry per step of the window, except `spectrum`.
struct SpectrumTrace {
  std::vector<double> acceleration;      ///< γ^z (m/s²)
  std::vector<double> power;             ///< m²/s⁴
  std::vector<double> median_frequency;  ///< Hz
  std::vector<double> p_switch;          ///< P(S_t ≠ S_t−1)
  std::vector<double> p_takeoff;         ///< P(S_t = ¬C | S_t−1 = C)
  std::vector<double> p_landing;         ///< P(S_t = C | S_t−1 = ¬C)
  /// A_t(ω) = |â_t(ω)|²/N, Eq. (10), of the window that ends at every `spectrum_stride`-th step
  /// (m²/s⁴). Index: step, then frequency bin.
  std::vector<std::vector<double>> spectrum;
};

inline constexpr std::size_t spectrum_stride = 2;

/// Torques of the left leg as its servos report them (N·m).
struct TorqueTrace {
  std::vector<double> knee, wheel;
};

/// One estimator's P(contact) of the left wheel.
struct BeliefTrace {
  std::string estimator;
  std::string title;  ///< for display
  std::vector<double> p_contact;
};

/// The drop at one noise setting.
struct NoisyDrop {
  noise::NoiseCell noise;
  TorqueTrace torque;
  /// log (P(m_t | C) / P(m_t | ¬C)) of the left leg, Eq. (6), by the estimator
  /// `DropDetail::transition_of`. NaN if the experiment has not fitted that estimator.
  std::vector<double> torque_evidence;
  SpectrumTrace spectrum;
  std::vector<BeliefTrace> beliefs;
};

/// The quantities of the paper's Fig. 5 for one drop: columns with one entry per step.
struct DropDetail {
  std::string simulator;
  std::optional<double> at = {};      ///< a time that the file names instead of a drop (s)
  std::vector<double> time;           ///< since takeoff, or since `at` (s)
  std::vector<double> height;         ///< of the base, relative to takeoff (m)
  std::vector<std::uint8_t> contact;  ///< of the left wheel, by its label
  double bin_width = 0.0;             ///< of the spectra (Hz)
  std::string transition_of;          ///< the estimator of the spectra and the evidence
  double switch_power = 0.0;          ///< where P(switch) is one half (m²/s⁴)
  TorqueTrace torque;                 ///< noiseless
  SpectrumTrace spectrum;             ///< noiseless
  std::vector<NoisyDrop> noisy;       ///< by noise setting
};

/// Runs the estimators on the whole run with the noise of the study, and keeps the window around
/// the drop. Models are those that were fitted in the same engine. The spectra are those of the
/// first estimator with a transition model, else of `robust`. `recording` is the source of `run`.
/// Errors: `InputError` when the run has no such drop.
DropDetail drop_detail(const Experiment& experiment, const DetailConfig& config,
                       const recordings::Recording& recording, const RunSignals& run,
                       const FittedModels& models);

}  // namespace touchdown::experiments
