#include "estimator/phase/prepared_model.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "core/error.hpp"

namespace touchdown {

namespace {

/// The densities of acceleration by phase, times the exponent. The single-wheel phases share one.
std::vector<float> by_phase(std::span<const float> log_density, double exponent) {
  constexpr std::size_t values = acceleration_density_count;
  std::vector<float> result;
  for (std::size_t cell = 0; cell < log_density.size(); cell += values) {
    for (std::size_t k = 0; k < phase_count; ++k) {
      result.push_back(static_cast<float>(
          exponent * static_cast<double>(log_density[cell + std::min(k, values - 1)])));
    }
  }
  return result;
}

void add(PhaseRow& sum, float weight, const float* cell) noexcept {
  for (std::size_t k = 0; k < phase_count; ++k) sum[k] += weight * cell[k];
}

PhaseNoiseLevels noise_levels_of(std::vector<double> bandwidths, double first_noise) {
  const double h = bandwidths.front();
  return {std::move(bandwidths), std::sqrt(std::max(0.0, h * h - first_noise * first_noise))};
}

const PhaseFilterConfig& checked(const PhaseFilterConfig& config) {
  check_phase_filter_config(config);
  return config;
}

/// The number of the model's steps per step of a filter at `filter_rate` (Hz). Throws InputError
/// unless it is a whole number.
int phase_stride(double model_rate, double filter_rate) {
  const double ratio = model_rate / filter_rate;
  const double stride = std::round(ratio);
  if (!(stride >= 1.0 && std::abs(ratio - stride) < 1e-6 * stride)) {
    throw InputError("phase filter: a sample rate of " + std::to_string(filter_rate) +
                     " Hz is not the model's " + std::to_string(model_rate) +
                     " Hz divided by a whole number");
  }
  return static_cast<int>(stride);
}

/// The exponent of likelihoods at that stride. Sparser samples count more each, but never more than
/// independent samples.
double phase_exponent(double exponent, int stride) {
  return std::max(exponent, std::min(1.0, exponent * stride));
}

/// A noise estimate up to the largest noise of the densities.
template <std::size_t channels>
NoiseEstimate<channels> noise_from(double floor, double largest, const PhaseFilterConfig& config) {
  return {floor, std::max(2.0 * floor, largest), config.noise_gain,
          config.noise_warm_up * config.sample_rate};
}

/// The position of each level of an estimate, or of the known noise, among the densities' levels.
template <std::size_t channels>
std::vector<PhaseNoiseLevel> placed(const PhaseNoiseLevels& densities,
                                    const NoiseEstimate<channels>& estimate,
                                    const std::optional<PhaseNoise>& known,
                                    double PhaseNoise::*part) {
  if (known) return {densities.place((*known).*part)};
  std::vector<PhaseNoiseLevel> levels;
  for (const double sigma : estimate.levels()) levels.push_back(densities.place(sigma));
  return levels;
}

}  // namespace

PhaseNoiseLevel PhaseNoiseLevels::place(double sigma) const {
  const double bandwidth = std::hypot(sigma, kernel_width);
  if (bandwidths.size() < 2 || !(bandwidth > bandwidths.front())) return {0, 0.0F};
  if (bandwidth >= bandwidths.back()) return {bandwidths.size() - 2, 1.0F};
  const auto above = std::upper_bound(bandwidths.begin(), bandwidths.end(), bandwidth);
  const auto level = static_cast<std::size_t>(above - bandwidths.begin()) - 1;
  return {level, static_cast<float>(std::log(bandwidth / bandwidths[level]) /
                                    std::log(bandwidths[level + 1] / bandwidths[level]))};
}

PhaseTorqueTables::PhaseTorqueTables(std::span<const PhaseTorqueDensity> densities, double exponent)
    : exponent_(static_cast<float>(exponent)) {
  std::vector<double> bandwidths;
  for (const PhaseTorqueDensity& density : densities.first(torque_level_count(densities))) {
    bandwidths.push_back(density.bandwidth.wheel);
  }
  noise_levels_ = noise_levels_of(std::move(bandwidths), densities.front().noise.wheel);
  for (const PhaseTorqueDensity& density : densities) {
    tables_.push_back({AxisLookup(density.knee), AxisLookup(density.wheel),
                       phase_count * static_cast<std::size_t>(density.knee.count),
                       density.log_density.data()});
  }
}

PhaseRow PhaseTorqueTables::operator()(double knee, double wheel, const PhaseNoiseLevel& knee_noise,
                                       const PhaseNoiseLevel& wheel_noise) const noexcept {
  PhaseRow sum{};
  const auto add_level = [&](const Table& table, float weight) {
    const AxisPosition k = table.knee.place(knee);
    const AxisPosition w = table.wheel.place(wheel);
    const float* const low = table.cells + static_cast<std::size_t>(w.index) * table.row +
                             static_cast<std::size_t>(k.index) * phase_count;
    const float* const high = low + table.row;
    const auto knee_weight = static_cast<float>(k.weight);
    const float high_weight = weight * static_cast<float>(w.weight);
    const float low_weight = weight - high_weight;
    add(sum, low_weight * (1.0F - knee_weight), low);
    add(sum, low_weight * knee_weight, low + phase_count);
    add(sum, high_weight * (1.0F - knee_weight), high);
    add(sum, high_weight * knee_weight, high + phase_count);
  };
  const std::size_t levels = noise_levels_.bandwidths.size();
  const Table* const corner = tables_.data() + knee_noise.level * levels + wheel_noise.level;
  const float larger = std::max(knee_noise.weight, wheel_noise.weight);
  const float smaller = std::min(knee_noise.weight, wheel_noise.weight);
  const std::size_t side = knee_noise.weight > wheel_noise.weight ? levels : 1;
  add_level(corner[0], 1.0F - larger);
  if (larger > smaller) add_level(corner[side], larger - smaller);
  if (smaller > 0.0F) add_level(corner[levels + 1], smaller);
  for (float& log_likelihood : sum) log_likelihood *= exponent_;
  return sum;
}

PhaseAccelerationTables::PhaseAccelerationTables(
    std::span<const PhaseAccelerationDensity> densities, double exponent) {
  std::vector<double> bandwidths;
  for (const PhaseAccelerationDensity& density : densities) {
    bandwidths.push_back(density.bandwidth);
    tables_.push_back({AxisLookup(density.axis), by_phase(density.log_density, exponent)});
  }
  noise_levels_ = noise_levels_of(std::move(bandwidths), densities.front().noise);
}

PhaseRow PhaseAccelerationTables::operator()(double acceleration,
                                             const PhaseNoiseLevel& noise) const noexcept {
  PhaseRow sum{};
  const auto add_level = [&](const Table& table, float weight) {
    const AxisPosition a = table.axis.place(acceleration);
    const float* const low = table.cells.data() + static_cast<std::size_t>(a.index) * phase_count;
    const float high_weight = weight * static_cast<float>(a.weight);
    add(sum, weight - high_weight, low);
    add(sum, high_weight, low + phase_count);
  };
  add_level(tables_[noise.level], 1.0F - noise.weight);
  if (noise.weight > 0.0F) add_level(tables_[noise.level + 1], noise.weight);
  return sum;
}

PhaseRecursion::PhaseRecursion(const PhaseModel& model, int stride) {
  using Matrix = Eigen::Matrix<double, phase_count, phase_count>;
  Matrix one;
  for (std::size_t i = 0; i < phase_count; ++i) {
    for (std::size_t j = 0; j < phase_count; ++j) {
      one(static_cast<int>(i), static_cast<int>(j)) = model.transition[i][j];
    }
  }
  Matrix all = one;
  for (int k = stride; k > 1; --k) all = all * one;
  for (std::size_t i = 0; i < phase_count; ++i) {
    for (std::size_t j = 0; j < phase_count; ++j) {
      transition_[i][j] = all(static_cast<int>(i), static_cast<int>(j));
    }
  }
}

PreparedPhaseModel::PreparedPhaseModel(std::shared_ptr<const PhaseModel> shared,
                                       const PhaseFilterConfig& config)
    : model(std::move(shared)),
      recursion(*model, phase_stride(model->sample_rate, checked(config).sample_rate)),
      torque(model->torque, phase_exponent(config.torque_exponent,
                                           phase_stride(model->sample_rate, config.sample_rate))),
      acceleration(model->acceleration,
                   phase_exponent(config.acceleration_exponent,
                                  phase_stride(model->sample_rate, config.sample_rate))),
      knee_noise(
          noise_from<2>(config.noise_floor.knee_torque, model->torque.back().noise.knee, config)),
      wheel_noise(
          noise_from<2>(config.noise_floor.wheel_torque, model->torque.back().noise.wheel, config)),
      acceleration_noise(
          noise_from<1>(config.noise_floor.acceleration, model->acceleration.back().noise, config)),
      knee_levels(
          placed(torque.noise_levels(), knee_noise, config.noise, &PhaseNoise::knee_torque)),
      wheel_levels(
          placed(torque.noise_levels(), wheel_noise, config.noise, &PhaseNoise::wheel_torque)),
      acceleration_levels(placed(acceleration.noise_levels(), acceleration_noise, config.noise,
                                 &PhaseNoise::acceleration)) {}

}  // namespace touchdown
