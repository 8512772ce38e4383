#include "experiments/studies/sensor_sweep/study.hpp"

#include "experiments/studies/section_study.hpp"
#include "experiments/studies/sensor_sweep/config.hpp"
#include "experiments/studies/sensor_sweep/figures.hpp"
#include "experiments/studies/sensor_sweep/tables.hpp"

namespace touchdown::experiments {

namespace {

class SensorSweepStudy final : public SectionStudy<SensorSweepConfig> {
 public:
  std::optional<StudySection> section() const override { return sensor_sweep_section(); }

  void add_needs(const RunRequest& request, Needs& needs) const override {
    for (const SensorFactor& factor : section_of(request.experiment).factors) {
      needs.setups += static_cast<double>(factor.values.size());
    }
  }

  void plan(const RunRequest& request, Plan& plan) const override {
    add_sensor_sweep(request, plan);
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const std::vector<SensorSweepPoint> sweep = sensor_sweep(evaluation);
    write_tables(sweep, directory);
    const Experiment& experiment = evaluation.request.experiment;
    return {{sensor_sweep_text(sweep, experiment)},
            {},
            sensor_sweep_figures(directory.read_table("sensor_sweep.csv"), experiment)};
  }
};

}  // namespace

std::unique_ptr<const Study> sensor_sweep_study() {
  return std::make_unique<const SensorSweepStudy>();
}

}  // namespace touchdown::experiments
