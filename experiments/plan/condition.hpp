#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "noise/gaussian.hpp"

namespace touchdown::experiments {

/// Who listens to what: an estimator fitted on one engine's runs, tested on another's or the same.
struct Condition {
  std::string fit_simulator;
  std::string test_simulator;
  std::string estimator;
  std::string fit = {};  ///< which fit of that engine; empty: the experiment's
  int refit = 0;         ///< 0: to all of its runs; else to the so-manieth draw from them

  /// Whether it was fitted where it is tested, with the fit that is at home there.
  bool is_fitted_in_domain(std::string_view own_fit = {}) const {
    return refit == 0 && is_in_domain(own_fit);
  }
  /// Likewise, or to a draw from the runs of that fit.
  bool is_in_domain(std::string_view own_fit) const {
    return fit_simulator == test_simulator && fit == own_fit;
  }
  friend bool operator==(const Condition&, const Condition&) = default;
};

/// Under which its model is found among the fitted ones.
std::string model_key(const std::string& simulator, const std::string& fit, int refit = 0);
bool is_of_refit(std::string_view model_key);

/// The experiment's estimators on the engine they were fitted on, "always contact" last.
std::vector<Condition> own_engine_conditions(const Experiment& experiment);

/// Those that are tested on this engine.
std::vector<Condition> tested_on(std::vector<Condition> conditions, const std::string& simulator);

/// The key of what is drawn for a run under this number of a stream; independent of everything else
/// that the seed decides.
noise::NoiseKey draws_of(const Experiment& experiment, std::uint64_t stream, std::uint64_t number,
                         std::int64_t run);

/// The key of one noise realisation.
noise::NoiseKey noise_key(const Experiment& experiment, int noise_seed, std::int64_t run);

}  // namespace touchdown::experiments
