#include "experiments/studies/sensor_sweep/study.hpp"

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
  return {{sensor_sweep_text(sweep, evaluation.request.experiment)}};
}

}  // namespace touchdown::experiments
