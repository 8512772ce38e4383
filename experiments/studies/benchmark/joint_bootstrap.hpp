#pragma once

#include <cstdint>
#include <vector>

#include "core/interval.hpp"
#include "scoring/bootstrap.hpp"
#include "scoring/classification.hpp"

namespace touchdown::experiments {

/// One estimator in one scene: what was counted in each of its runs (the statistical samples), by
/// the estimator as it was fitted and by its refits.
struct FitsAndRuns {
  std::vector<scoring::Classification> runs;
  std::vector<std::vector<scoring::Classification>> of_refit = {};
};

/// Balanced accuracy over all runs, and over each of the resamples.
struct Resampled {
  double estimate = 0.0;
  std::vector<double> values = {};  ///< none of a single run
};

/// A bootstrap over fits and runs together. Of n runs a resample holds n − 1, drawn with
/// replacement: of few clusters as many as there are would have too little variance, by (n − 1)/n
/// (Rao and Wu 1988). If there are refits, each resample hears a refit drawn with it; equal
/// `bootstrap` draw the same of them in every scene, as estimators are fitted once for all of them.
/// `scene` keeps the draws of runs of different scenes apart.
Resampled balanced_accuracy(const FitsAndRuns& scores, std::uint64_t scene,
                            const scoring::BootstrapConfig& bootstrap);

/// The mean of things that were resampled together. Those without resamples make it one without.
Resampled mean(const std::vector<const Resampled*>& all);

Interval interval_of(const Resampled& resampled, double level);

}  // namespace touchdown::experiments
