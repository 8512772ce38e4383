#pragma once

#include <cstdint>
#include <vector>

#include "core/interval.hpp"
#include "scoring/bootstrap.hpp"
#include "scoring/classification.hpp"

namespace touchdown::experiments {

/// One estimator in one scene: counts of each run (the statistical samples), for the estimator's
/// fit and for its refits.
struct FitsAndRuns {
  std::vector<scoring::Classification> runs;
  std::vector<std::vector<scoring::Classification>> of_refit = {};
};

/// The same from the counts by fit: of the estimator's fit, then of its refits.
FitsAndRuns fits_and_runs(std::vector<std::vector<scoring::Classification>> by_fit);

/// Balanced accuracy over all runs, and over each of the resamples.
struct Resampled {
  double estimate = 0.0;
  std::vector<double> values = {};  ///< none for a single run
};

/// A bootstrap over fits and runs together. A resample holds n − 1 of n runs, drawn with
/// replacement: n draws would underestimate the variance by the factor (n − 1)/n (Rao and Wu 1988).
/// Each resample also draws one of the refits, if there are any. Equal `bootstrap` draws the same
/// refits in every scene, since estimators are fitted once for all scenes. `scene` separates the
/// draws of runs of different scenes.
Resampled balanced_accuracy(const FitsAndRuns& scores, std::uint64_t scene,
                            const scoring::BootstrapConfig& bootstrap);

/// The mean of quantities that were resampled together. It has no resamples if one of them has
/// none.
Resampled mean(const std::vector<const Resampled*>& all);

/// The difference of quantities that were resampled together.
Resampled operator-(const Resampled& first, const Resampled& second);

Interval interval_of(const Resampled& resampled, double level);

}  // namespace touchdown::experiments
