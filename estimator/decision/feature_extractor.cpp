#include "estimator/decision/feature_extractor.hpp"

#include <Eigen/Core>

#include "estimator/low_pass.hpp"

namespace touchdown {

namespace {

constexpr double unobservable_load = 15.0;  // N
constexpr double least_area = 0.003;        // m²
constexpr double least_servo_area = 0.001;  // m²: tracking errors are more precise than torques
constexpr double area_of_noise = 0.004;     // m² for each N·m
constexpr double largest_load = 200.0;      // N: four times Upkie's weight
constexpr double largest_feature = 1e4;     // of the others, so that floats hold them

/// Clamps the value to ± `largest`; NaN becomes 0.
double within(double value, double largest) noexcept {
  return std::isnan(value) ? 0.0 : std::clamp(value, -largest, largest);
}

const DecisionConfig& checked(const DecisionConfig& config) {
  check_decision_config(config);
  return config;
}

constexpr double shortest_scale = 1e-3;  // s
constexpr double warm_up = 0.1;          // s, of the noise estimates
constexpr double noise_gain = 0.01;
constexpr double reference_rate = 1000.0;  // Hz

using Scales = Eigen::Array<float, static_cast<int>(decision_scales), 1>;

/// All time scales of a channel, compressed by its softsign.
Scales compressed(const LowPassBank& channel, float scale) noexcept {
  const Scales y = Eigen::Map<const Scales>(channel.values().data()) * (1.0F / scale);
  return y / (1.0F + y.abs() / saturation);
}

/// The place of a channel among these inputs.
auto scales_at(auto& inputs, std::size_t begin) noexcept {
  return Eigen::Map<Scales>(inputs.data() + begin);
}

}  // namespace

LegFeatureExtractor::LegFeatureExtractor(const DecisionConfig& config, bool mirrored)
    : geometry_(config.geometry), mass_ratio_(mass_ratio(config.geometry)), mirrored_(mirrored) {
  const double steps = std::clamp(std::round(config.difference * config.sample_rate), 1.0, 1e4);
  velocities_.resize(static_cast<std::size_t>(steps));
  rate_ = config.sample_rate / steps;
}

// Inline, because position-independent code calls all other functions.
inline double LegFeatureExtractor::load_of(const FootJacobian& foot, double force_times_area,
                                           double least, double torque_noise) const noexcept {
  const double area = foot.determinant();
  const double noisy_area = area_of_noise * torque_noise;
  const double damping = least * least + noisy_area * noisy_area;
  const double load = (area * mass_ratio_ * force_times_area + damping * unobservable_load) /
                      (area * area + damping);
  return within(load, largest_load);
}

ServoLoadFeature LegFeatureExtractor::servo_load(const FootJacobian& foot,
                                                 const ServoLoad& load) const noexcept {
  if (!std::isfinite(load.force_times_determinant)) return {unobservable_load, true};
  return {load_of(foot, load.force_times_determinant, least_servo_area,
                  mass_ratio_ * load.torque_noise),
          false};
}

LegFeatures LegFeatureExtractor::update(const LegSignals& leg, const FootJacobian& foot,
                                        double vertical_acceleration,
                                        double torque_noise) noexcept {
  const double sign = mirrored_ ? -1.0 : 1.0;
  const std::array<double, 2> now = {sign * leg.wheel.velocity,
                                     within(axle_velocity(foot, leg, mirrored_), largest_feature)};
  const std::array<double, 2> before = count_ < velocities_.size() ? now : velocities_[next_];
  velocities_[next_] = now;
  next_ = next_ + 1 == velocities_.size() ? 0 : next_ + 1;
  count_ = std::min(count_ + 1, velocities_.size());

  const double force_times_determinant =
      vertical_force_times_determinant(geometry_, foot, leg, mirrored_, vertical_acceleration);
  const double load = load_of(foot, force_times_determinant, least_area, torque_noise);
  const double reaction =
      sign * leg.wheel.torque - geometry_.wheel_inertia * rate_ * (now[0] - before[0]);
  return {load, within(mass_ratio_ * reaction, largest_feature), now[1],
          within(vertical_acceleration + rate_ * (now[1] - before[1]), largest_feature),
          force_times_determinant};
}

LowPassBank::LowPassBank(double sample_rate) noexcept {
  for (std::size_t i = 0; i < decision_scales; ++i) {
    gains_[i] = static_cast<float>(
        exact_low_pass_gain(std::ldexp(shortest_scale, static_cast<int>(i)), sample_rate));
  }
}

void LowPassBank::fast_forward(double input, double seconds) noexcept {
  if (!is_started_) return;
  const auto x = static_cast<float>(input);
  for (std::size_t i = 0; i < decision_scales; ++i) {
    const double time_constant = std::ldexp(shortest_scale, static_cast<int>(i));
    values_[i] += static_cast<float>(-std::expm1(-seconds / time_constant)) * (x - values_[i]);
  }
}

FeatureExtractor::FeatureExtractor(const DecisionConfig& config)
    : config_(checked(config).guard),
      geometry_(config.geometry),
      mass_ratio_(mass_ratio(config.geometry)),
      guard_(config.guard, config.sample_rate),
      leg_repetition_{Repetition<9>(config.guard, config.sample_rate),
                      Repetition<9>(config.guard, config.sample_rate)},
      gyro_repetition_(config.guard, config.sample_rate),
      leg_extractor_{LegFeatureExtractor(config, false), LegFeatureExtractor(config, true)},
      leg_{LegFilters{LowPassBank(config.sample_rate), LowPassBank(config.sample_rate),
                      LowPassBank(config.sample_rate), LowPassBank(config.sample_rate)},
           LegFilters{LowPassBank(config.sample_rate), LowPassBank(config.sample_rate),
                      LowPassBank(config.sample_rate), LowPassBank(config.sample_rate)}},
      has_servo_load_(config.servo_load),
      servo_load_{LowPassBank(config.sample_rate), LowPassBank(config.sample_rate)},
      acceleration_(config.sample_rate),
      roll_rate_(config.sample_rate),
      density_(std::sqrt(reference_rate / config.sample_rate)),
      log_density_(std::log(density_)),
      torque_noise_(0.01, 10.0, noise_gain, warm_up * config.sample_rate),
      acceleration_noise_(0.05, 30.0, noise_gain, warm_up * config.sample_rate),
      load_estimates_(config.geometry, config.sample_rate) {}

void FeatureExtractor::reset() noexcept {
  guard_.reset();
  for (Repetition<9>& leg : leg_repetition_) leg.reset();
  gyro_repetition_.reset();
  torque_noise_.reset();
  acceleration_noise_.reset();
  for (LegFeatureExtractor& leg : leg_extractor_) leg.reset();
  load_estimates_.reset();
  load_ = {};
  reset_features();
  leg_age_ = {};
  acceleration_age_ = roll_rate_age_ = 0.0;
}

void FeatureExtractor::reset_features() noexcept {
  for (LegFilters& leg : leg_) {
    for (LowPassBank& channel : leg) channel.reset();
  }
  for (LowPassBank& channel : servo_load_) channel.reset();
  acceleration_.reset();
  roll_rate_.reset();
}

/// All sensors were silent for `seconds`.
void FeatureExtractor::dropout(double seconds) noexcept {
  for (double& age : leg_age_) age += seconds;
  acceleration_age_ += seconds;
  roll_rate_age_ += seconds;
  torque_noise_.reset_signals();
  acceleration_noise_.reset_signals();
  load_estimates_.reset();
}

// The next functions are inline, because position-independent code calls all others.

/// Whether a source is frozen. One that reports only zeros may not exist.
template <std::size_t count>
inline bool is_frozen(Repetition<count>& source, const std::array<double, count>& values) noexcept {
  return source.update(values) && values != std::array<double, count>{};
}

/// Whether the leg's bus hangs: all its servos repeat themselves. A single servo may be at rest.
inline bool FeatureExtractor::is_frozen(const LegSignals& leg, std::size_t side) noexcept {
  return touchdown::is_frozen<9>(
      leg_repetition_[side],
      {leg.hip.position, leg.hip.velocity, leg.hip.torque, leg.knee.position, leg.knee.velocity,
       leg.knee.torque, leg.wheel.position, leg.wheel.velocity, leg.wheel.torque});
}

/// After a dropout longer than a gap, the present input counts for all of it.
inline void FeatureExtractor::update(LowPassBank& channel, double input,
                                     double age) const noexcept {
  if (age > config_.maximum_gap) channel.fast_forward(input, age);
  channel.update(input);
}

inline void FeatureExtractor::update_servo_load(const ServoLoad& load, std::size_t side,
                                                const FootJacobian& foot, double age) noexcept {
  const ServoLoadFeature feature = leg_extractor_[side].servo_load(foot, load);
  is_muted_ = is_muted_ || feature.is_muted;
  update(servo_load_[side], feature.load, age);
}

inline void FeatureExtractor::update_legs(const Signals& signals,
                                          const std::array<bool, 2>& is_valid,
                                          bool has_acceleration, double elapsed) noexcept {
  const std::array<FootJacobian, 2> foot = foot_jacobians(geometry_, signals.leg);
  const double noise = torque_noise();
  std::array<LegLoad, 2> loads;
  is_muted_ = false;
  for (std::size_t side = 0; side < 2; ++side) {
    double& age = leg_age_[side];
    if (!is_valid[side]) {
      age += elapsed;
      continue;
    }
    if (age > config_.maximum_gap) leg_extractor_[side].reset();
    const LegFeatures features = leg_extractor_[side].update(signals.leg[side], foot[side],
                                                             signals.vertical_acceleration, noise);
    update(leg_[side][1], features.reaction, age);
    update(leg_[side][2], features.axle_velocity, age);
    if (has_acceleration) {  // load and axle acceleration need it
      const double longer = std::max(age, acceleration_age_);
      update(leg_[side][0], features.load, longer);
      update(leg_[side][3], features.axle_acceleration, longer);
      LegLoad& load = loads[side];
      load.is_usable = true;
      load.by_torques = features.force_times_determinant;
      load.by_servos =
          touchdown::servo_load(geometry_, foot[side], signals.leg[side], signals.target[side],
                                side == 1, signals.vertical_acceleration, config_);
      if (has_servo_load_) update_servo_load(load.by_servos, side, foot[side], longer);
    }
    age = 0.0;
  }
  load_ = load_estimates_.update(
      foot, loads, {torque_noise_.sigma() / mass_ratio_, acceleration_noise_.sigma()});
  // A leg without usable signals takes over the features of the other leg.
  for (std::size_t side = 0; side < 2; ++side) {
    if (is_valid[side] || !is_valid[1 - side]) continue;
    leg_[side] = leg_[1 - side];
    servo_load_[side] = servo_load_[1 - side];
    leg_age_[side] = 0.0;
    leg_extractor_[side].reset();
  }
}

/// Writes the logarithms of both noise levels.
inline void FeatureExtractor::write_noise(float* inputs) const noexcept {
  inputs[0] = static_cast<float>(torque_noise_.log_sigma() + log_density_);
  inputs[1] = static_cast<float>(acceleration_noise_.log_sigma() + log_density_);
}

/// Each channel continues while its own sensor works, so that it need not restart when another
/// sensor returns.
FeatureExtractor::Step FeatureExtractor::update(const Signals& signals) noexcept {
  const SignalGuard::Verdict verdict = guard_.check(signals.time, signals.vertical_acceleration);
  Step step{verdict.status, verdict.elapsed, verdict.elapsed > config_.maximum_gap, {}};
  load_ = {};
  if (!std::isfinite(signals.time)) return step;  // no record: the next record's time gives the gap
  if (step.restart) dropout(step.elapsed);
  const auto report = [&](SignalStatus status) {
    if (step.status == SignalStatus::good) step.status = status;
  };
  std::array<bool, 2> has_leg{};
  for (std::size_t side = 0; side < 2; ++side) {
    const LegSignals& leg = signals.leg[side];
    const bool frozen = is_frozen(leg, side);
    const bool usable = is_usable(leg, config_);
    has_leg[side] = usable && !frozen;
    if (!usable) report(SignalStatus::invalid);
    if (frozen) report(SignalStatus::frozen);
  }
  const Eigen::Vector3d& turn = signals.angular_velocity;
  const bool is_gyro_frozen =
      touchdown::is_frozen<3>(gyro_repetition_, {turn.x(), turn.y(), turn.z()});
  const bool has_roll_rate = std::isfinite(turn.x()) && !is_gyro_frozen;
  if (is_gyro_frozen) report(SignalStatus::frozen);
  if (!std::isfinite(turn.x())) step.status = SignalStatus::invalid;
  for (std::size_t side = 0; side < 2; ++side) {
    step.is_valid[side] = has_leg[side] && verdict.acceleration_good && has_roll_rate;
  }

  const double elapsed = step.restart ? 0.0 : step.elapsed;  // `dropout` counted the gap
  update_legs(signals, has_leg, verdict.acceleration_good, elapsed);
  if (is_muted_) report(SignalStatus::degraded);
  if (verdict.acceleration_good) {
    update(acceleration_, signals.vertical_acceleration, acceleration_age_);
    acceleration_age_ = 0.0;
  } else {
    acceleration_age_ += elapsed;
  }
  if (has_roll_rate) {
    constexpr double fastest_roll = 1e4;  // rad/s
    update(roll_rate_, std::clamp(turn.x(), -fastest_roll, fastest_roll), roll_rate_age_);
    roll_rate_age_ = 0.0;
  } else {
    roll_rate_age_ += elapsed;
  }
  const auto knee_torque = [&](std::size_t side) {
    return has_leg[side] ? mass_ratio_ * signals.leg[side].knee.torque : std::nan("");
  };
  torque_noise_.update({knee_torque(0), knee_torque(1)});
  acceleration_noise_.update(
      {verdict.acceleration_good ? signals.vertical_acceleration : std::nan("")});
  return step;
}

void FeatureExtractor::compute_inputs() noexcept {
  constexpr std::size_t of_legs = DecisionPairInputs::of_legs;
  for (std::size_t i = 0; i < decision_leg_channels; ++i) {
    const std::size_t begin = i * decision_scales;
    scales_at(inputs_, begin) = compressed(leg_[0][i], leg_softsign_scales[i]);
    scales_at(inputs_, of_legs + begin) = compressed(leg_[1][i], leg_softsign_scales[i]);
  }
  if (has_servo_load_) {
    scales_at(servo_inputs_, 0) = compressed(servo_load_[0], leg_softsign_scales[0]);
    scales_at(servo_inputs_, decision_scales) = compressed(servo_load_[1], leg_softsign_scales[0]);
  }
  scales_at(inputs_, 2 * of_legs) = compressed(acceleration_, acceleration_softsign_scale);
  scales_at(inputs_, 2 * of_legs + decision_scales) =
      compressed(roll_rate_, roll_rate_softsign_scale);
  write_noise(inputs_.end() - 2);
}

void FeatureExtractor::compute_pair_inputs() noexcept {
  constexpr std::size_t of_legs = DecisionPairInputs::of_legs;
  for (std::size_t i = 0; i < decision_leg_channels; ++i) {
    const std::size_t begin = i * decision_scales;
    const Scales left = compressed(leg_[0][i], leg_softsign_scales[i]);
    const Scales right = compressed(leg_[1][i], leg_softsign_scales[i]);
    scales_at(pair_.common, begin) = left + right;
    scales_at(pair_.difference, begin) = left - right;
  }
  if (has_servo_load_) {
    const Scales left = compressed(servo_load_[0], leg_softsign_scales[0]);
    const Scales right = compressed(servo_load_[1], leg_softsign_scales[0]);
    scales_at(pair_.servo_common, 0) = left + right;
    scales_at(pair_.servo_difference, 0) = left - right;
  }
  scales_at(pair_.common, of_legs) = compressed(acceleration_, acceleration_softsign_scale);
  scales_at(pair_.difference, of_legs) = compressed(roll_rate_, roll_rate_softsign_scale);
  write_noise(pair_.common.end() - 2);
}

}  // namespace touchdown
