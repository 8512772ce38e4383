#include "experiments/estimators/parameter_fitting.hpp"

#include <algorithm>
#include <deque>

#include "estimator/signal_bounds.hpp"
#include "experiments/signals/reserved_seeds.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

namespace {

/// The run's signals as an estimator gets them: NaN in place of values beyond their bounds. Runs
/// without such values are not copied.
std::span<const Signals> usable_signals(const RunSignals& run,
                                        std::deque<std::vector<Signals>>& copies) {
  const SignalCheck check;
  const bool is_usable = std::all_of(
      run.signals.begin(), run.signals.end(),
      [&](const Signals& step) { return check.first_unusable(step) == SignalIndex::none; });
  if (is_usable) return run.signals;
  std::vector<Signals>& copy = copies.emplace_back(run.signals);
  for (Signals& step : copy) step = check.without_unusable(step);
  return copy;
}

}  // namespace

FittedModel fit_parameters(const EstimatorEntry& entry, const FitRuns& runs,
                           const FitParameters& fit) {
  std::vector<LabelledRun> labelled;
  std::deque<std::vector<Signals>> copies;
  for (const RunSignals* run : runs.whole) {
    check_may_be_fitted(run->info);
    labelled.push_back({.signals = usable_signals(*run, copies),
                        .contact = {run->contact[0], run->contact[1]},
                        .sample_rate = 1.0 / period_of(*run),
                        .skip = skipped_steps(*run, runs.scoring.skip),
                        .legs = run->legs});
  }
  return {.parameters =
              std::make_shared<const recordings::ParameterModelFile>(recordings::ParameterModelFile{
                  entry.name, fit(labelled),
                  provenance_of(entry.name, runs.whole, runs.scoring.skip)})};
}

}  // namespace touchdown::experiments
