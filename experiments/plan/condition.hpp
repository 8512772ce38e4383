#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/columns.hpp"
#include "experiments/config/experiment.hpp"
#include "noise/gaussian.hpp"
#include "noise/sensor_noise.hpp"

namespace touchdown::experiments {

/// An estimator, the engine of the runs that it is fitted to, and the engine of its test runs.
struct Condition {
  std::string fit_simulator;
  std::string test_simulator;
  std::string estimator;
  std::string fit = {};  ///< name of the fit on that engine; empty: the experiment's own
  int refit = 0;         ///< 0: fitted to all runs; n: to the n-th resample of them

  /// Whether it was fitted on the engine of its test, with this fit, to all runs.
  bool is_fitted_in_domain(std::string_view own_fit = {}) const {
    return refit == 0 && is_in_domain(own_fit);
  }
  /// The same, also with a fit to a resample of the runs.
  bool is_in_domain(std::string_view own_fit) const {
    return fit_simulator == test_simulator && fit == own_fit;
  }
  friend bool operator==(const Condition&, const Condition&) = default;
};

/// The key of a fit in `FittedModels`.
std::string model_key(const std::string& simulator, const std::string& fit, int refit = 0);
/// Whether the key belongs to a fit to resampled runs, or to a training set of a part of the runs.
bool is_of_refit(std::string_view model_key);

/// The columns of a noise setting: `torque_noise_nm`, `accelerometer_noise_mps2`.
Columns<noise::NoiseCell> noise_columns();

/// The separate levels of a setting, for tables of the knee × wheel grid: `knee_noise_nm`,
/// `wheel_noise_nm`.
Columns<noise::NoiseCell> knee_wheel_columns();

/// The experiment's estimators, each tested on the engine of its fit, "always contact" last.
std::vector<Condition> own_engine_conditions(const Experiment& experiment);

std::vector<Condition> tested_on(std::vector<Condition> conditions, const std::string& simulator);

/// The key of random draws for a run, by stream and number. It is independent of all other uses of
/// the seed.
noise::NoiseKey draws_of(std::uint64_t seed, std::uint64_t stream, std::uint64_t number,
                         std::int64_t run);

noise::NoiseKey noise_key(const Experiment& experiment, int noise_seed, std::int64_t run);

}  // namespace touchdown::experiments
