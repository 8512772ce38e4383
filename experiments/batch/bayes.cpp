#include "experiments/batch/bayes.hpp"

#include <utility>

namespace touchdown::experiments {
namespace {

bool is_finite(const Signals& clean, const NoiseStep& draws) noexcept {
  double sum = clean.vertical_acceleration * 0.0 + draws.acceleration * 0.0;
  for (std::size_t side = 0; side < 2; ++side) {
    sum += clean.leg[side].knee.torque * 0.0 + clean.leg[side].wheel.torque * 0.0;
    sum += draws.torque[side].knee * 0.0 + draws.torque[side].wheel * 0.0;
  }
  return sum == 0.0;  // 0 × anything finite is 0, 0 × anything else is NaN
}

}  // namespace

BatchedTransitions::BatchedTransitions(const TransitionConfig& config, double sample_rate,
                                       std::span<const double> sigmas)
    : law_(config, sample_rate),
      clean_(config.window),
      noise_(config.window),
      magnitude_(config.median_of == SpectrumKind::magnitude),
      magnitudes_(clean_, config.nyquist),
      powers_(clean_, config.nyquist),
      sigmas_(sigmas.begin(), sigmas.end()),
      spectrum_(sigmas.size()),
      filtered_median_(sigmas.size()),
      stay_(sigmas.size()),
      takeoff_(sigmas.size()),
      landing_(sigmas.size()),
      fly_(sigmas.size()) {}

void BatchedTransitions::update(double vertical_acceleration, double draw) noexcept {
  clean_.push(vertical_acceleration);
  noise_.push(draw);
  if (magnitude_) {
    magnitudes_.summarise(clean_, noise_, sigmas_, spectrum_);
  } else {
    powers_.summarise(clean_, noise_, sigmas_, spectrum_);
  }
  const std::size_t count = sigmas_.size();
  const SpectrumValues* const spectrum = spectrum_.data();
  double* const filtered_median = filtered_median_.data();
  double* const stay = stay_.data();
  double* const takeoff = takeoff_.data();
  double* const landing = landing_.data();
  double* const fly = fly_.data();
  const TransitionLaw law = law_;
  law.with_power([=](const auto& power) {
  // The arrays do not overlap, which the compiler cannot know.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
    for (std::size_t i = 0; i < count; ++i) {
      const Transition t =
          law.next(power(spectrum[i].mean_square), spectrum[i].median_bin, filtered_median[i]);
      filtered_median[i] = t.filtered_median_frequency;
      stay[i] = t.contact_to_contact;
      takeoff[i] = t.contact_to_air;
      landing[i] = t.air_to_contact;
      fly[i] = t.air_to_air;
    }
  });
}

BatchedBayesFilter::BatchedBayesFilter(MeasurementModel model, const BayesFilterConfig& config,
                                       std::span<const BatchNoise> levels)
    : torque_(levels, torque_part),
      acceleration_(levels, &BatchNoise::acceleration),
      measurement_(std::move(model), config, torque_.level),
      transition_(config.transition, config.sample_rate, acceleration_.level) {
  for (auto* belief : {&contact_, &no_contact_}) belief->fill(std::vector(levels.size(), 0.5));
}

void BatchedBayesFilter::update(const Signals& clean, const NoiseStep& draws) noexcept {
  if (!is_finite(clean, draws)) return;
  transition_.update(clean.vertical_acceleration, draws.acceleration);  // Eq. (7) to (13)
  measurement_.observe(clean, draws);                                   // Eq. (4) to (6)
  const double* const stay = transition_.contact_to_contact().data();
  const double* const takeoff = transition_.contact_to_air().data();
  const double* const landing = transition_.air_to_contact().data();
  const double* const fly = transition_.air_to_air().data();
  const std::uint32_t* const torque_index = torque_.level_index.data();
  const std::uint32_t* const acceleration_index = acceleration_.level_index.data();
  const std::size_t count = size();
  for (const Side side : {Side::left, Side::right}) {
    const double* const p_contact = measurement_.contact(side).data();
    const double* const p_no_contact = measurement_.no_contact(side).data();
    double* const contact = contact_[static_cast<std::size_t>(side)].data();
    double* const no_contact = no_contact_[static_cast<std::size_t>(side)].data();
    // The arrays do not overlap, which the compiler cannot know.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC ivdep
#endif
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t a = acceleration_index[i];
      const std::uint32_t torque = torque_index[i];
      const double bel = contact[i];
      const double not_bel = no_contact[i];
      // Eq. (2a), (2b) and (3)
      const double joint = p_contact[torque] * (stay[a] * bel + landing[a] * not_bel);
      const double not_joint = p_no_contact[torque] * (takeoff[a] * bel + fly[a] * not_bel);
      const double eta = joint + not_joint;
      // The division comes before the check for zero: selecting values is vector code, a branch is
      // not.
      const double corrected = joint / eta;
      const double not_corrected = not_joint / eta;
      contact[i] = eta > 0.0 ? corrected : bel;
      no_contact[i] = eta > 0.0 ? not_corrected : not_bel;
    }
  }
}

}  // namespace touchdown::experiments
