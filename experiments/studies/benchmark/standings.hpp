#pragma once

#include <string>
#include <vector>

#include "core/interval.hpp"
#include "experiments/studies/benchmark/rows.hpp"

namespace touchdown::experiments {

/// The ranking of estimators on one robot with its sensors, at one noise setting, in both engines.
struct Standings {
  std::string robot;
  std::string sensors;
  noise::NoiseCell noise;

  /// One estimator over all scenes and engines, with equal weights.
  struct Entry {
    std::string estimator;
    Interval mean;       ///< of balanced accuracy; scenes, fits and runs are resampled
    double worst = 0.0;  ///< lowest balanced accuracy over scenes and engines
    std::string worst_scene;
    std::string worst_simulator;
    /// Whether the simultaneous band of its difference from the best includes zero. Reference upper
    /// bounds never count as the best.
    bool is_not_significantly_worse = false;
    /// Mean over scenes and engines (1/min per wheel).
    double extra_switches = 0.0;
    /// Mean log loss over scenes and engines (bits per wheel and step).
    double log_loss = 0.0;
    /// Log loss minus the least one of the reference upper bounds (bits per wheel and step). NaN
    /// without an upper bound.
    double excess_log_loss = 0.0;
    std::size_t scored = 0;   ///< pairs of scene and engine with a scored run
    std::size_t planned = 0;  ///< pairs of scene and engine
  };
  std::vector<Entry> entries;  ///< by mean, the best first

  /// Balanced accuracy of the first estimator minus that of the second, on the same runs, resampled
  /// together: the mean over engines in one scene; or, if `scene` is empty, over scenes, which are
  /// resampled, too, and engines.
  struct Difference {
    std::string scene;
    std::string first;
    std::string second;
    Interval value;
  };
  /// All pairs, by scene. The bands of a scene hold simultaneously. Their half-width in standard
  /// errors is the 95 % quantile, over resamples, of the largest deviation of any pair.
  std::vector<Difference> differences;
};

/// Standings of in-domain estimators that were scored in every scored run.
std::vector<Standings> standings(const std::vector<BenchmarkRow>& rows,
                                 const scoring::BootstrapConfig& intervals);

/// The same over the unseen scenes alone, with differences of means only. Empty without such
/// scenes.
std::vector<Standings> standings_of_unseen(const std::vector<BenchmarkRow>& rows,
                                           const scoring::BootstrapConfig& intervals);

}  // namespace touchdown::experiments
