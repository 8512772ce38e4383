#include "experiments/studies/cross_simulator/study.hpp"

#include "experiments/studies/cross_simulator/config.hpp"
#include "experiments/studies/cross_simulator/figures.hpp"
#include "experiments/studies/cross_simulator/tables.hpp"
#include "experiments/studies/section_study.hpp"

namespace touchdown::experiments {

namespace {

class CrossSimulatorStudy final : public SectionStudy<CrossSimulatorConfig> {
 public:
  std::optional<StudySection> section() const override { return cross_simulator_section(); }

  void add_needs(const RunRequest& request, Needs& needs) const override {
    const Experiment& experiment = request.experiment;
    const auto& config = section_of(experiment);
    double variations = 0.0;
    for (const Factor& factor : config.factors) {
      // One of the values may be the nominal one, which the experiment's own runs cover.
      variations += static_cast<double>((factor.values.size() - 1) * factor.simulators.size());
    }
    add_runs(needs, scenario_of(request, experiment.test.scenarios.front()).scenario,
             variations * config.sensitivity_runs, experiment.noise.seeds);
  }

  void plan(const RunRequest& request, Plan& plan) const override {
    add_cross_simulator(request, plan);
    plan.pictured.insert(section_of(request.experiment).overlay.run);
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const CrossSimulatorResult check = check_across_simulators(evaluation);
    write_tables(check, directory);
    const Experiment& experiment = evaluation.request.experiment;
    std::vector<FigureSpec> figures = {
        transfer_figure(directory.read_table("transfer.csv"), experiment)};
    for (FigureSpec& figure :
         sensitivity_figures(directory.read_table("sensitivity.csv"), experiment)) {
      figures.push_back(std::move(figure));
    }
    return {{report_text(check)}, failed_demands(check.verdicts), std::move(figures)};
  }
};

}  // namespace

std::unique_ptr<const Study> cross_simulator_study() {
  return std::make_unique<const CrossSimulatorStudy>();
}

}  // namespace touchdown::experiments
