#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/columns.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "experiments/results/scores.hpp"
#include "scoring/bootstrap.hpp"
#include "scoring/classification.hpp"

namespace touchdown::experiments {

/// A part of countable events, for metrics that are shares. It adds over runs.
struct Share {
  std::int64_t part = 0;
  std::int64_t whole = 0;

  Share& operator+=(const Share& other) {
    part += other.part;
    whole += other.whole;
    return *this;
  }
  /// NaN without events.
  double value() const { return scoring::ratio(part, whole); }
};

/// A statistic of a study's measure: of one condition in one noise setting, with its bootstrap
/// interval over runs.
template <typename Score>
struct Estimate {
  Condition condition;
  noise::NoiseCell noise;
  std::size_t runs = 0;
  Score total;  ///< over the runs
  Interval value;
};

/// The statistic over the experiment's own test runs, by condition, then noise setting. `measure`
/// measures predictions: one score of type `Score` each.
template <typename Score>
std::vector<Estimate<Score>> estimates(std::string_view measure,
                                       const std::function<double(const Score&)>& statistic,
                                       const Evaluation& evaluation) {
  const std::vector<noise::NoiseCell>& cells = evaluation.plan.groups.front().scored;
  std::vector<Estimate<Score>> all;
  for (const ConditionSamples<Score>& found : measured_samples<Score>(
           measure, evaluation.plan.runs_in(0), evaluation.plan, evaluation.saved)) {
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      const std::vector<Score>& samples = found.samples[cell];
      if (samples.empty()) continue;
      const scoring::BootstrapConfig& config = evaluation.request.experiment.intervals.bootstrap;
      all.push_back({found.condition, cells[cell], samples.size(), scoring::sum(samples),
                     scoring::bootstrap<Score>(samples, {statistic}, config).front()});
    }
  }
  return all;
}

/// The columns of such a table: `simulator`, `estimator`, the noise setting, `runs`, the statistic
/// under its name.
template <typename Score>
Columns<Estimate<Score>> estimate_columns(const std::string& statistic) {
  using Row = Estimate<Score>;
  return Columns<Row>()
      .text("simulator", [](const Row& row) { return row.condition.test_simulator; })
      .text("estimator", [](const Row& row) { return row.condition.estimator; })
      .part(&Row::noise, noise_columns())
      .runs("runs", &Row::runs)
      .interval(statistic, &Row::value);
}

}  // namespace touchdown::experiments
