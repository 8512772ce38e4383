#include "experiments/studies/cross_simulator/study.hpp"

#include "experiments/studies/cross_simulator/figures.hpp"
#include "experiments/studies/cross_simulator/tables.hpp"

namespace touchdown::experiments {

bool CrossSimulatorStudy::is_requested(const Experiment& experiment) const {
  return experiment.cross_simulator.has_value();
}

void CrossSimulatorStudy::add_needs(const RunRequest& request, Needs& needs) const {
  const Experiment& experiment = request.experiment;
  double variations = 0.0;
  for (const Factor& factor : experiment.cross_simulator->factors) {
    // One of the values may be the nominal one, which the experiment's own runs cover.
    variations += static_cast<double>((factor.values.size() - 1) * factor.simulators.size());
  }
  add_runs(needs, scenario_of(request, experiment.test.scenarios.front()).scenario,
           variations * experiment.cross_simulator->sensitivity_runs, experiment.noise.seeds);
}

void CrossSimulatorStudy::plan(const RunRequest& request, Plan& plan) const {
  add_cross_simulator(request, plan);
  plan.pictured.insert(request.experiment.cross_simulator->overlay.run);
}

StudyResult CrossSimulatorStudy::summarize(const Evaluation& evaluation,
                                           const RunDirectory& directory) const {
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

}  // namespace touchdown::experiments
