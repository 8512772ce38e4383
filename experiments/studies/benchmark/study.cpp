#include "experiments/studies/benchmark/study.hpp"

#include "experiments/studies/benchmark/config.hpp"
#include "experiments/studies/benchmark/overlap.hpp"
#include "experiments/studies/benchmark/submission_rows.hpp"
#include "experiments/studies/section_study.hpp"

namespace touchdown::experiments {

namespace {

class BenchmarkStudy final : public SectionStudy<BenchmarkConfig> {
 public:
  std::optional<StudySection> section() const override { return benchmark_section(); }

  void add_needs(const RunRequest& request, Needs& needs) const override {
    // Each robot may run differently, and each combination of robot and sensors has fitted runs.
    const Experiment& experiment = request.experiment;
    const auto& benchmark = section_of(experiment);
    const auto robots = 1.0 + static_cast<double>(benchmark.robots.size());
    const auto profiles = 1.0 + static_cast<double>(benchmark.sensors.size());
    const double others = robots * profiles - 1.0;
    const auto engines = static_cast<double>(experiment.simulators.size());
    for (const std::string& file : experiment.fit.scenarios) {
      add_runs(needs, scenario_of(request, file).scenario, others * engines * experiment.fit.runs,
               0.0);
    }
    needs.setups += others;
  }

  void plan(const RunRequest& request, Plan& plan) const override { add_benchmark(request, plan); }

  KeptSignals kept_signals(const Experiment& /*experiment*/) const override {
    return KeptSignals::none;
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const BenchmarkResult found = write_benchmark(evaluation, directory);
    write_overlap(evaluation.models, evaluation, directory);
    return {{benchmark_text(found, evaluation.request.experiment)}};
  }
};

}  // namespace

std::unique_ptr<const Study> benchmark_study() { return std::make_unique<const BenchmarkStudy>(); }

}  // namespace touchdown::experiments
