#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/interval.hpp"
#include "experiments/evaluation/scored.hpp"
#include "scoring/bootstrap.hpp"
#include "scoring/classification.hpp"

namespace touchdown::experiments {

/// The counts of each run (the statistical samples): of an estimator's fit, then of its refits,
/// each in the same runs.
using CountsByFit = std::vector<std::vector<scoring::Classification>>;

/// A unique number for every scene and engine, for draws of their own.
std::uint64_t stream_of(std::size_t scene, const std::string& simulator,
                        const Experiment& experiment);

/// Balanced accuracy over all runs, and over each of the resamples.
struct Resampled {
  double estimate = 0.0;
  std::vector<double> values = {};  ///< of resampled fits and runs; none for a single run
  /// Of resampled fits alone, over all runs; also for a single run. Empty: fits do not matter.
  std::vector<double> of_fits = {};
};

/// A bootstrap over fits and runs together. A resample holds n − 1 of n runs, drawn with
/// replacement: n draws would underestimate the variance by the factor (n − 1)/n (Rao and Wu 1988).
/// Each resample also draws one of the refits, if there are any. A refit sees fewer different runs
/// than the estimator's own fit and is worse on average, so this bias is subtracted: values stay
/// centred on the estimate. Equal `bootstrap` draws the same refits in every scene, since
/// estimators are fitted once for all scenes. `scene` separates the draws of runs of different
/// scenes.
Resampled balanced_accuracy(const CountsByFit& by_fit, std::uint64_t scene,
                            const scoring::BootstrapConfig& bootstrap);

/// The same for fits of equal rank, such as those to different training sets: nothing is
/// subtracted. The estimate is the mean over fits.
Resampled balanced_accuracy_of_fits(const CountsByFit& by_fit, std::uint64_t scene,
                                    const scoring::BootstrapConfig& bootstrap);

/// The mean of quantities that were resampled together. It has no resamples if one of them has
/// none.
Resampled mean(const std::vector<const Resampled*>& all);

/// One quantity of a scene: of each engine, resampled together.
using SceneValues = std::vector<Resampled>;

/// The mean over scenes and engines with equal weights of each value, with scenes, fits and runs
/// resampled together. A resample draws n − 1 of n scenes with replacement, and a drawn scene
/// brings all of its runs: their scatter is part of that between scenes, and drawing them again
/// would count it twice (Davison and Hinkley 1997, section 3.8). One scene alone resamples its
/// runs, as `mean`. Equal `bootstrap` draws the same scenes and refits for every estimator.
Resampled mean_over_scenes(const std::vector<SceneValues>& scenes,
                           const scoring::BootstrapConfig& bootstrap);

/// The difference of quantities that were resampled together.
Resampled operator-(const Resampled& first, const Resampled& second);

Interval interval_of(const Resampled& resampled, double level);

/// Rows of one estimator at one noise setting, its refits included.
using EstimatorRows = std::vector<const Scored<scoring::RobotScore>*>;

/// Balanced accuracy, both wheels added, in each scene and engine of the rows.
std::vector<SceneValues> balanced_accuracies(const EstimatorRows& rows,
                                             const Experiment& experiment);

}  // namespace touchdown::experiments
