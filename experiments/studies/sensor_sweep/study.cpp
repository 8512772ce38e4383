#include "experiments/studies/sensor_sweep/study.hpp"

#include "experiments/studies/sensor_sweep/figures.hpp"
#include "experiments/studies/sensor_sweep/tables.hpp"

namespace touchdown::experiments {

bool SensorSweepStudy::is_requested(const Experiment& experiment) const {
  return !experiment.sweep.empty();
}

void SensorSweepStudy::add_needs(const RunRequest& request, Needs& needs) const {
  for (const SensorFactor& factor : request.experiment.sweep) {
    needs.setups += static_cast<double>(factor.values.size());
  }
}

void SensorSweepStudy::plan(const RunRequest& request, Plan& plan) const {
  add_sensor_sweep(request, plan);
}

StudyResult SensorSweepStudy::summarize(const Evaluation& evaluation,
                                        const RunDirectory& directory) const {
  const std::vector<SensorSweepPoint> sweep = sensor_sweep(evaluation);
  write_tables(sweep, directory);
  const Experiment& experiment = evaluation.request.experiment;
  return {{sensor_sweep_text(sweep, experiment)},
          {},
          sensor_sweep_figures(directory.read_table("sensor_sweep.csv"), experiment)};
}

}  // namespace touchdown::experiments
