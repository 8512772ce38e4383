#include "experiments/estimators/parameter_fitting.hpp"

#include "experiments/signals/reserved_seeds.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

FittedModel fit_parameters(const EstimatorEntry& entry, const FitRuns& runs,
                           const FitParameters& fit) {
  std::vector<LabelledRun> labelled;
  for (const RunSignals* run : runs.whole) {
    check_may_be_fitted(run->info);
    labelled.push_back({.signals = run->signals,
                        .contact = {run->contact[0], run->contact[1]},
                        .sample_rate = 1.0 / period_of(*run),
                        .skip = skipped_steps(*run, runs.scoring.skip)});
  }
  return {.parameters =
              std::make_shared<const recordings::ParameterModelFile>(recordings::ParameterModelFile{
                  entry.name, fit(labelled),
                  provenance_of(entry.name, runs.whole, runs.scoring.skip)})};
}

}  // namespace touchdown::experiments
