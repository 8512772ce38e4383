#include "estimator/phase_filter.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Core>

#include "core/error.hpp"
#include "estimator/exponential.hpp"

namespace touchdown {
namespace {

/// P(contact) = 0.5 for each wheel, for any and for both; half of no contact is flight.
constexpr PhaseProbabilities prior = [] {
  PhaseProbabilities p{};
  p[index(Phase::rolling)] = 0.5;
  p[index(Phase::flight)] = 0.25;
  p[index(Phase::held)] = 0.25;
  return p;
}();

/// The padding's log likelihood: e^−700 of the largest.
constexpr double impossible = -1e9;

/// How many of the model's steps one step of the filter takes.
int stride_of(double model_rate, double filter_rate) {
  const double ratio = model_rate / filter_rate;
  const double stride = std::round(ratio);
  if (!(stride >= 1.0 && std::abs(ratio - stride) < 1e-6 * stride)) {
    throw InputError("phase filter: a sample rate of " + std::to_string(filter_rate) +
                     " Hz is not the model's " + std::to_string(model_rate) +
                     " Hz divided by a whole number");
  }
  return static_cast<int>(stride);
}

const PhaseModel& checked(const PhaseModel& model, const PhaseFilterConfig& config) {
  check_phase_filter_config(config);
  check_phase_model(model);
  return model;
}

/// Fewer samples each tell more, but never more than independent ones do.
double exponent_at(double exponent, int stride) {
  return std::max(exponent, std::min(1.0, exponent * stride));
}

template <typename Densities>
double ceiling_of(const Densities& densities, double floor) {
  return std::max(2.0 * floor, densities.back().noise);
}

template <typename Tables>
std::vector<PhaseNoiseLevel> levels_of(const Tables& tables, const std::vector<double>& sigmas) {
  std::vector<PhaseNoiseLevel> levels;
  for (const double sigma : sigmas) levels.push_back(tables.place(sigma));
  return levels;
}

}  // namespace

PhaseFilter::PhaseFilter(const PhaseModel& model, const PhaseFilterConfig& config)
    : config_(config),
      torque_(
          checked(model, config).torque,
          exponent_at(config.torque_exponent, stride_of(model.sample_rate, config.sample_rate))),
      acceleration_(model.acceleration,
                    exponent_at(config.acceleration_exponent,
                                stride_of(model.sample_rate, config.sample_rate))),
      guard_(config.guard, config.sample_rate),
      torque_noise_(config.noise_floor.torque, ceiling_of(model.torque, config.noise_floor.torque),
                    config.noise_gain, config.noise_warm_up * config.sample_rate),
      acceleration_noise_(config.noise_floor.acceleration,
                          ceiling_of(model.acceleration, config.noise_floor.acceleration),
                          config.noise_gain, config.noise_warm_up * config.sample_rate) {
  torque_levels_ =
      levels_of(torque_, config.noise ? std::vector{config.noise->torque} : torque_noise_.rungs());
  acceleration_levels_ =
      levels_of(acceleration_, config.noise ? std::vector{config.noise->acceleration}
                                            : acceleration_noise_.rungs());
  using Matrix = Eigen::Matrix<double, phase_count, phase_count>;
  Matrix one;
  for (std::size_t i = 0; i < phase_count; ++i) {
    for (std::size_t j = 0; j < phase_count; ++j) {
      one(static_cast<int>(i), static_cast<int>(j)) = model.transition[i][j];
    }
  }
  Matrix all = one;
  for (int k = stride_of(model.sample_rate, config.sample_rate); k > 1; --k) all = all * one;
  for (std::size_t i = 0; i < phase_count; ++i) {
    for (std::size_t j = 0; j < phase_count; ++j) {
      transition_[i][j] = all(static_cast<int>(i), static_cast<int>(j));
    }
  }
  reset();
}

void PhaseFilter::reset() noexcept {
  guard_.reset();
  torque_noise_.reset();
  acceleration_noise_.reset();
  alpha_ = {};
  std::copy(prior.begin(), prior.end(), alpha_.begin());
  belief_ = Belief{};
  for (WheelBelief& wheel : belief_.wheel) wheel.contact = true;
  conclude();
}

PhaseProbabilities PhaseFilter::phases() const noexcept {
  PhaseProbabilities p{};
  std::copy_n(alpha_.begin(), phase_count, p.begin());
  return p;
}

PhaseNoise PhaseFilter::noise() const noexcept {
  return config_.noise.value_or(PhaseNoise{torque_noise_.sigma(), acceleration_noise_.sigma()});
}

const Belief& PhaseFilter::update(const Signals& signals) noexcept {
  const SignalGuard::Verdict verdict = guard_.check(signals.time, signals.vertical_acceleration);
  belief_.status = verdict.status;
  std::array<bool, 2> torques_good{};
  for (std::size_t side = 0; side < 2; ++side) {
    const LegSignals& leg = signals.leg[side];
    torques_good[side] = std::isfinite(leg.knee.torque) && std::isfinite(leg.wheel.torque);
    if (!torques_good[side]) belief_.status = SignalStatus::invalid;
  }
  const bool usable = verdict.acceleration_good && (torques_good[0] || torques_good[1]);
  if (verdict.restart) {
    torque_noise_.forget_signals();
    acceleration_noise_.forget_signals();
  }
  if (verdict.restart || !usable) forget(verdict.elapsed);
  if (!usable) {
    conclude();
    return belief_;
  }
  if (!config_.noise) listen_to_noise(signals, verdict.acceleration_good);

  const PhaseNoiseLevel torque_level = torque_levels_[config_.noise ? 0 : torque_noise_.rung()];
  const PhaseNoiseLevel acceleration_level =
      acceleration_levels_[config_.noise ? 0 : acceleration_noise_.rung()];
  const auto evidence = [&](std::size_t side) {
    const LegSignals& leg = signals.leg[side];
    const double mirror = side == 0 ? 1.0 : -1.0;
    return torques_good[side]
               ? torque_(mirror * leg.knee.torque, mirror * leg.wheel.torque, torque_level)
               : PhaseRow{};
  };
  const PhaseRow left = evidence(0);
  const PhaseRow right = evidence(1);
  const PhaseRow vertical = acceleration_(signals.vertical_acceleration, acceleration_level);

  Lanes log_likelihood;
  for (std::size_t k = 0; k < phase_lanes; ++k) {
    log_likelihood[k] = static_cast<double>(left[k] + right[k] + vertical[k]);
  }
  constexpr std::size_t touching = index(Phase::rolling);
  constexpr std::size_t free = index(Phase::flight);
  const float single = vertical[acceleration_density_count - 1];
  log_likelihood[index(Phase::left_only)] =
      static_cast<double>(left[touching] + right[free] + single);
  log_likelihood[index(Phase::right_only)] =
      static_cast<double>(left[free] + right[touching] + single);
  log_likelihood[phase_count] = impossible;
  predict_and_correct(log_likelihood);
  conclude();
  return belief_;
}

/// The belief after `elapsed` seconds without news.
void PhaseFilter::forget(double elapsed) noexcept {
  const double kept = std::exp(-elapsed / config_.guard.relaxation);
  for (std::size_t k = 0; k < phase_count; ++k) {
    alpha_[k] = kept * alpha_[k] + (1.0 - kept) * prior[k];
  }
}

void PhaseFilter::listen_to_noise(const Signals& s, bool acceleration_good) noexcept {
  torque_noise_.update(
      {s.leg[0].knee.torque, s.leg[0].wheel.torque, s.leg[1].knee.torque, s.leg[1].wheel.torque});
  if (acceleration_good) acceleration_noise_.update({s.vertical_acceleration});
}

/// α'_j ∝ e_j · Σ_i α_i A_ij.
void PhaseFilter::predict_and_correct(const Lanes& log_likelihood) noexcept {
  Lanes predicted{};
  for (std::size_t i = 0; i < phase_count; ++i) {
    for (std::size_t j = 0; j < phase_lanes; ++j) {
      predicted[j] += alpha_[i] * transition_[i][j];
    }
  }
  double largest = log_likelihood[0];
  for (std::size_t k = 1; k < phase_lanes; ++k) largest = std::max(largest, log_likelihood[k]);
  double sum = 0.0;
  for (std::size_t k = 0; k < phase_lanes; ++k) {
    predicted[k] *= exponential(log_likelihood[k] - largest);
    sum += predicted[k];
  }
  const double scale = 1.0 / sum;
  for (std::size_t k = 0; k < phase_lanes; ++k) alpha_[k] = predicted[k] * scale;
}

void PhaseFilter::conclude() noexcept {
  const double left_only = alpha_[index(Phase::left_only)];
  const double right_only = alpha_[index(Phase::right_only)];
  const double none = alpha_[index(Phase::flight)] + alpha_[index(Phase::held)];
  const auto bounded = [](double p) { return std::clamp(p, 0.0, 1.0); };
  belief_.wheel[0].p_contact = bounded(1.0 - (none + right_only));
  belief_.wheel[1].p_contact = bounded(1.0 - (none + left_only));
  belief_.p_any_wheel = bounded(1.0 - none);
  belief_.p_both_wheels = bounded(1.0 - (none + left_only + right_only));
  for (WheelBelief& wheel : belief_.wheel) {
    wheel.contact = wheel.contact ? wheel.p_contact >= config_.leave_below
                                  : wheel.p_contact > config_.return_above;
  }
}

}  // namespace touchdown
