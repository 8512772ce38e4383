#include "estimator/bayes/noisy_measurement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include <Eigen/Core>

#include "estimator/numerics/flush_denormals.hpp"

namespace touchdown {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Standard deviations by which the densities are widened (N·m). Above the last one contact and
/// air hardly differ, and wider densities only lower the decisions below the threshold.
constexpr std::array<double, 4> widening = {0.0, 0.025, 0.05, 0.1};

/// The widening per standard deviation of white noise: a share of what the torques' low-pass
/// leaves.
double widening_gain(const MeasurementConfig& config, double sample_rate) {
  const double gain = low_pass_gain(config.torque.low_pass, 1.0 / sample_rate);
  return config.noise.share * std::sqrt(gain / (2.0 - gain));
}

/// The axis of a widened density: as coarse as the noise allows.
Axis axis_under(const Axis& fitted, double sigma) {
  if (sigma == 0.0) return fitted;
  const double step = 0.4 * sigma;
  const int points = 1 + static_cast<int>(std::ceil((fitted.upper - fitted.lower) / step));
  return {fitted.lower, fitted.upper, std::clamp(points, 2, fitted.count)};
}

double normal_density(double x, double sigma) {
  const double u = x / sigma;
  return std::exp(-0.5 * u * u) / (sigma * std::sqrt(2.0 * std::numbers::pi));
}

/// One axis under noise: the density at the widened axis' points is this matrix times the fitted
/// one. Absolute values fold the noise at zero.
Matrix widening_kernel(const Axis& fitted, const Axis& wide, double sigma, bool folds) {
  Matrix kernel(wide.count, fitted.count);
  for (int i = 0; i < wide.count; ++i) {
    for (int j = 0; j < fitted.count; ++j) {
      double density = normal_density(wide[i] - fitted[j], sigma);
      if (folds) density += normal_density(wide[i] + fitted[j], sigma);
      const bool is_end = j == 0 || j == fitted.count - 1;
      kernel(i, j) = density * fitted.step() * (is_end ? 0.5 : 1.0);
    }
  }
  return kernel;
}

/// One axis at every level of noise.
struct WidenedAxis {
  WidenedAxis(const Axis& fitted, bool is_absolute) {
    const bool folds = is_absolute && fitted.lower >= 0.0;
    for (const double sigma : widening) {
      axis.push_back(axis_under(fitted, sigma));
      kernel.push_back(sigma > 0.0 ? widening_kernel(fitted, axis.back(), sigma, folds) : Matrix());
    }
  }
  std::vector<Axis> axis;
  std::vector<Matrix> kernel;  ///< empty without noise
};

/// A density at every level: rows of the wheel, columns of the knee, by knee level, then wheel
/// level.
std::vector<std::vector<double>> widened(const std::vector<double>& grid, const WidenedAxis& knee,
                                         const WidenedAxis& wheel) {
  const Eigen::Map<const Matrix> fitted(grid.data(), wheel.axis[0].count, knee.axis[0].count);
  std::vector<std::vector<double>> all;
  for (const Matrix& by_knee : knee.kernel) {
    const Matrix rows = by_knee.size() > 0 ? Matrix(fitted * by_knee.transpose()) : Matrix(fitted);
    for (const Matrix& by_wheel : wheel.kernel) {
      const Matrix wide = by_wheel.size() > 0 ? Matrix(by_wheel * rows) : rows;
      all.emplace_back(wide.data(), wide.data() + wide.size());
    }
  }
  return all;
}

std::vector<MeasurementModel> widened_models(MeasurementModel model, bool is_absolute) {
  const FlushDenormals flush;
  const LikelihoodGrids fitted = model.grids();
  const WidenedAxis knee(fitted.knee, is_absolute);
  const WidenedAxis wheel(fitted.wheel, is_absolute);
  const auto contact = widened(fitted.contact, knee, wheel);
  const auto no_contact = widened(fitted.no_contact, knee, wheel);
  std::vector<MeasurementModel> models = {std::move(model)};
  for (std::size_t level = 1; level < contact.size(); ++level) {
    models.emplace_back(LikelihoodGrids{knee.axis[level / widening.size()],
                                        wheel.axis[level % widening.size()], contact[level],
                                        no_contact[level]});
  }
  return models;
}

/// The nearest level of the densities for each level of a noise estimate, by the logarithm. Below
/// half of the first one the densities stay as fitted.
std::shared_ptr<const std::size_t[]> nearest_levels(const NoiseEstimate<2>& estimate, double gain) {
  const std::span<const double> sigmas = estimate.levels();
  const auto nearest = std::make_shared<std::size_t[]>(sigmas.size());
  for (std::size_t i = 0; i < sigmas.size(); ++i) {
    std::size_t level = 0;
    while (level + 1 < widening.size()) {
      const double next = widening[level + 1];
      const double boundary = level == 0 ? 0.5 * next : std::sqrt(widening[level] * next);
      if (gain * sigmas[i] < boundary) break;
      ++level;
    }
    nearest[static_cast<std::ptrdiff_t>(i)] = level;
  }
  return nearest;
}

NoiseEstimate<2> noise_estimate(const TorqueNoiseConfig& noise, double sample_rate) {
  return {noise.floor, noise.ceiling, noise.gain, noise.warm_up * sample_rate};
}

}  // namespace

NoisyMeasurement::NoisyMeasurement(MeasurementModel model, const MeasurementConfig& config)
    : models_(std::make_shared<const std::vector<MeasurementModel>>(
          config.noise.is_followed
              ? widened_models(std::move(model), config.torque.sign == TorqueSign::absolute)
              : std::vector<MeasurementModel>{std::move(model)})),
      floor_{config.contact_floor, config.no_contact_floor} {}

TorqueNoise::TorqueNoise(const MeasurementConfig& config, double sample_rate)
    : follows_(config.noise.is_followed),
      knee_(noise_estimate(config.noise, sample_rate)),
      wheel_(knee_),
      densities_(widening.size()),
      nearest_(nearest_levels(knee_, widening_gain(config, sample_rate))) {}

void TorqueNoise::reset() noexcept {
  knee_.reset();
  wheel_.reset();
}

void TorqueNoise::reset_signals() noexcept {
  knee_.reset_signals();
  wheel_.reset_signals();
}

std::size_t TorqueNoise::update(const Signals& signals, const SignalGuardConfig& guard) noexcept {
  if (!follows_) return 0;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::array<double, 2> knee = {none, none};
  std::array<double, 2> wheel = {none, none};
  for (std::size_t side = 0; side < 2; ++side) {
    const LegSignals& leg = signals.leg[side];
    if (!has_torques(leg, guard)) continue;
    knee[side] = leg.knee.torque;
    wheel[side] = leg.wheel.torque;
  }
  return update(knee, wheel);
}

}  // namespace touchdown
