#pragma once

#include <array>
#include <cmath>

#include "estimator/members.hpp"
#include "estimator/numerics/exponential.hpp"
#include "estimator/numerics/sliding_dft.hpp"

namespace touchdown {

/// 1 / (1 + exp(−(x − offset) / slope)): half at `offset`, steeper for a smaller `slope` (both in
/// the unit of x).
struct Sigmoid {
  double offset = 0.0;
  double slope = 1.0;

  [[nodiscard]] double operator()(double x) const noexcept {
    return 1.0 / (1.0 + exponential((offset - x) / slope));
  }
  bool operator==(const Sigmoid&) const = default;
};

/// Which measure of a window's power the switch probability uses.
enum class PowerMeasure : int {
  /// The mean over all bins of A_t(ω), Eq. (10); the same as the window's mean square (m²/s⁴).
  mean_square,
  /// ‖â_t‖²/N, the sum over all bins of A_t(ω): N times the mean square (m²/s⁴).
  energy,
  /// The window's root mean square (m/s²).
  root_mean_square,
};

struct TransitionConfig {
  /// N of Eq. (9): number of accelerometer samples in the sliding window.
  int window = 128;
  /// The measure of power A_t in Eq. (11).
  PowerMeasure power = PowerMeasure::mean_square;
  /// The spectrum of which Eq. (12) takes the median.
  SpectrumKind median_of = SpectrumKind::power;
  /// Whether the median counts the bin of the Nyquist frequency.
  bool nyquist = true;
  /// σ_1 of Eq. (11), of the power (in its unit).
  Sigmoid switch_sigmoid{8.0, 1.0};
  /// σ_2 of Eq. (13), of the median frequency (Hz).
  Sigmoid landing_sigmoid{7.5, 2.5};
  /// Both sigmoids stay at least this far from 0 and 1.
  double margin = 0.0;
  /// Time constant (s) of a low-pass of (median frequency × P(switch)), which replaces the median
  /// frequency in Eq. (13). It advances twice per step, as in the authors' code. 0 = no memory.
  double median_memory = 0.0;
  /// true: P(stay) = 1 − P(leave), so each row of the transition matrix sums to one. false: the
  /// published P(stay) = 1 − P(switch), with rows that sum to less.
  bool row_stochastic = true;

  bool operator==(const TransitionConfig&) const = default;
};

inline constexpr std::array power_names = {"mean_square", "energy", "root_mean_square"};
inline constexpr std::array spectrum_names = {"power", "magnitude"};
static_assert(static_cast<int>(PowerMeasure::root_mean_square) == 2 &&
              static_cast<int>(SpectrumKind::magnitude) == 1);

void members(auto& visit, MembersOf<TransitionConfig> auto& transition) {
  visit("transition.window", transition.window);
  visit.choose("transition.power", power_names, transition.power);
  visit.choose("transition.median_of", spectrum_names, transition.median_of);
  visit("transition.nyquist", transition.nyquist);
  visit("transition.switch.offset", transition.switch_sigmoid.offset, Range::any);
  visit("transition.switch.slope", transition.switch_sigmoid.slope, Range::positive);
  visit("transition.landing.offset", transition.landing_sigmoid.offset, Range::any);
  visit("transition.landing.slope", transition.landing_sigmoid.slope, Range::positive);
  visit("transition.margin", transition.margin, Range{0.0, 0.5 - 1e-9, "0 to less than 0.5"});
  visit("transition.median_memory", transition.median_memory, Range::not_negative);
  visit("transition.row_stochastic", transition.row_stochastic);
}

/// P(S_t | S_t−1), and the quantities behind it.
struct Transition {
  // The matrix comes first: its four neighbouring numbers are stored as one vector, and the
  // recursion loads them as one.
  double contact_to_contact = 1.0;
  double contact_to_air = 0.0;  ///< takeoff
  double air_to_contact = 0.0;  ///< landing, Eq. (8)
  double air_to_air = 1.0;

  double power = 0.0;                      ///< m²/s⁴; as a root mean square m/s²
  double median_frequency = 0.0;           ///< Hz
  double filtered_median_frequency = 0.0;  ///< Hz; equals median_frequency without memory
  double p_switch = 0.0;                   ///< P(S_t ≠ S_t−1), Eq. (11)
  double p_landing = 0.5;                  ///< P(S_t = C | S_t ≠ S_t−1), Eq. (13)
};

/// The last part of the transition model, from the spectrum's summary to probabilities: Eq. (7),
/// (8), (11) and (13).
class TransitionLaw {
 public:
  /// Errors: as `check_members`; `InputError` for a rate that is not positive.
  TransitionLaw(const TransitionConfig& config, double sample_rate);

  /// The transition for this spectrum. `remembered` is the filtered median frequency of the
  /// previous transition (Hz).
  [[nodiscard]] Transition next(const SpectrumValues& spectrum, double remembered) const noexcept {
    Transition t;
    t.power = is_root_ ? root_of(spectrum.mean_square) : power_scale_ * spectrum.mean_square;
    const Odds switching = odds(switching_, t.power);  // Eq. (11)
    t.p_switch = switching.p;

    t.median_frequency = bin_width_ * spectrum.median_bin;
    const double input = t.median_frequency * t.p_switch;
    const double filtered = remembered + memory_gain_ * (input - remembered);
    t.filtered_median_frequency = memory_ > 0.0 ? filtered : t.median_frequency;
    const Odds landing = odds(landing_, t.filtered_median_frequency);  // Eq. (13)
    t.p_landing = landing.p;

    t.air_to_contact = landing.p * switching.p;      // Eq. (8)
    t.contact_to_air = landing.not_p * switching.p;  // likewise
    // 1 − P(leave) = P(no switch) + P(switch the other way), without cancellation.
    t.contact_to_contact = switching.not_p + repair_ * t.air_to_contact;
    t.air_to_air = switching.not_p + repair_ * t.contact_to_air;
    return t;
  }

 private:
  struct Odds {
    double p;
    double not_p;
  };
  /// A sigmoid prepared to be evaluated without a division.
  struct Steepness {
    double offset;
    double inverse_slope;
  };
  /// Rounding may make the square of an empty window slightly negative.
  [[nodiscard]] static double root_of(double square) noexcept {
    return std::sqrt(square > 0.0 ? square : 0.0);
  }
  /// A sigmoid and its complement, both to full relative precision. Near certainty, 1 − p would be
  /// rounding noise, and that noise would be the probability to stay.
  [[nodiscard]] Odds odds(const Steepness& sigmoid, double x) const noexcept {
    const double against = exponential((sigmoid.offset - x) * sigmoid.inverse_slope);
    const double p = 1.0 / (1.0 + against);
    return {within_margin(p), within_margin(against * p)};
  }
  [[nodiscard]] double within_margin(double p) const noexcept {
    const double above = p > margin_ ? p : margin_;
    return above < highest_ ? above : highest_;
  }

  Steepness switching_;
  Steepness landing_;
  double margin_;
  double highest_;
  bool is_root_;
  double power_scale_;
  double bin_width_;
  /// The gain of the low-pass over its two steps.
  double memory_gain_;
  double memory_;
  /// 1: rows sum to one; 0: as published.
  double repair_;
};

/// The paper's transition model. A landing or a takeoff changes the spectrum of the vertical
/// acceleration: its power indicates a switch of the state, its median frequency the direction of
/// the switch. Both legs share the model. Only the constructor allocates or throws.
class TransitionModel {
 public:
  /// sample_rate in Hz. Throws InputError for an invalid rate, slope, margin or memory.
  TransitionModel(const TransitionConfig& config, double sample_rate);

  /// Clears the window to zeros: a robot at rest.
  void reset() noexcept;

  /// Adds the newest vertical acceleration without gravity, γ^z (m/s², finite).
  const Transition& update(double vertical_acceleration) noexcept;

  [[nodiscard]] const Transition& transition() const noexcept { return transition_; }
  [[nodiscard]] const SlidingDft& spectrum() const noexcept { return dft_; }

 private:
  TransitionLaw law_;
  SlidingDft dft_;
  SpectrumSummary summary_;
  Transition transition_;
};

}  // namespace touchdown
