#pragma once

#include <string>
#include <vector>

#include "core/interval.hpp"
#include "experiments/studies/benchmark/rows.hpp"

namespace touchdown::experiments {

/// Estimators on one robot with its sensors, at one noise setting, in both engines.
struct Standings {
  std::string robot;
  std::string sensors;
  noise::NoiseCell noise;

  /// One estimator over all scenes and engines, each of which counts alike.
  struct Place {
    std::string estimator;
    Interval mean;  ///< of balanced accuracy
    double worst = 0.0;
    std::string worst_scene;
    std::string worst_simulator;
    /// The simultaneous band of its difference from the first includes zero; the learned ceiling
    /// is nobody's first.
    bool is_not_significantly_worse = false;
    /// Mean over scenes and engines (bits per wheel and step).
    double log_loss = 0.0;
    /// So much more than the learned ceiling's: what it leaves of what there is to be had. NaN
    /// without a ceiling.
    double bits_left = 0.0;
  };
  std::vector<Place> places;  ///< by mean, the best first

  /// The balanced accuracy of one estimator minus that of another, on the same runs, resampled
  /// together: in one scene, the mean of its engines, or, without a name, the mean of everything.
  struct Difference {
    std::string scene;
    std::string first;
    std::string second;
    Interval value;
  };
  /// All pairs, by scene. The bands of a scene hold all at once: each reaches as many standard
  /// errors as the largest deviation of any pair does in 95 % of the resamples.
  std::vector<Difference> differences;
};

/// Of estimators that are scored where they were fitted, in every run in which one of them is.
std::vector<Standings> standings(const std::vector<BenchmarkRow>& rows, double level);

}  // namespace touchdown::experiments
