#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/signals/run_signals.hpp"
#include "logs/recording.hpp"
#include "scoring/labels.hpp"

namespace touchdown::experiments {

/// The drops of a run, in order of time: flights of these wheels that begin after the run's first
/// step and last at least `minimum_flight` (s).
std::vector<scoring::Flight> drops(
    const std::array<scoring::ContactSequence, models::wheel_count>& contact, double period,
    double minimum_flight, DropWheels wheels = DropWheels::both);

/// "both wheels", "the left wheel", "the right wheel".
std::string_view to_text(DropWheels wheels);

/// The steps around one drop, or one time, that a figure shows: [begin, end), inside the run.
struct DropWindow {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t zero = 0;  ///< step of the takeoff, or of the chosen time

  std::size_t steps() const { return end - begin; }
};

/// The window around the chosen drop. `key` is the choice's key in the experiment file.
/// Errors: `InputError` that begins with the key and states the number of drops, or the duration,
/// of the run.
DropWindow drop_window(const RunSignals& run, const DropChoice& choice, double minimum_flight,
                       const std::string& key);

/// Time since the takeoff, or the chosen time, at every step of the window (s).
std::vector<double> time_in(const DropWindow& window, double period);

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
                       const logs::Recording& recording, const RunSignals& run,
                       const FittedModels& models);

}  // namespace touchdown::experiments
