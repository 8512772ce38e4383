#include "experiments/cross_simulator/sensitivity.hpp"

#include <algorithm>
#include <limits>

#include "scoring/bootstrap.hpp"

namespace touchdown::experiments {

std::vector<Sensitivity> sensitivity(const Variation& variation, const RunRequest& request,
                                     const Plan& plan, const PlayedRuns& runs,
                                     const SavedCounts& saved) {
  const Experiment& experiment = request.experiment;
  const std::vector<std::size_t> varied = runs_of(variation, request, plan);
  const auto failed = static_cast<std::size_t>(std::count_if(
      varied.begin(), varied.end(), [&](std::size_t run) { return runs.at(run).failed(); }));
  const CollectedCounts counts = collect(plan, varied, saved);
  const std::size_t cell = noise::cell_index(plan.groups[plan.runs[varied.front()].group].counted,
                                             experiment.highlights.front());
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Sensitivity> result;
  for (const ConditionCounts& count : counts.own()) {
    if (count.condition.test_simulator != variation.simulator) continue;
    Sensitivity row{variation.factor,
                    variation.value,
                    variation.nominal,
                    variation.simulator,
                    count.condition.estimator,
                    varied.size() - failed,
                    failed,
                    Interval{nan, nan, nan}};
    if (row.runs > 0) {
      row.success = scoring::bootstrap<scoring::Classification>(
                        count.samples[cell],
                        {[](const scoring::Classification& sum) { return sum.success(); }},
                        experiment.intervals.bootstrap)
                        .front();
    }
    result.push_back(std::move(row));
  }
  return result;
}

}  // namespace touchdown::experiments
