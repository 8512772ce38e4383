#include "experiments/studies/benchmark/overlap.hpp"

#include <algorithm>
#include <numeric>

#include "experiments/config/experiment_estimators.hpp"
#include "experiments/studies/benchmark/plan.hpp"
#include "scoring/distributions/overlap.hpp"

namespace touchdown::experiments {

namespace {

/// The overlap ∫ min(p, q) of two fitted densities on the first one's grid, in contact or in the
/// air. Each density is normalised on its own grid, because kernels reach below a torque of zero.
double common_part(const MeasurementModel& first, const MeasurementModel& second,
                   double Likelihoods::*density, std::vector<double> LikelihoodGrids::*grid) {
  const auto share = [&](const LikelihoodGrids& grids) {
    const std::vector<double>& values = grids.*grid;
    return 1.0 / std::accumulate(values.begin(), values.end(), 0.0);
  };
  const LikelihoodGrids grids = first.grids();
  const LikelihoodGrids others = second.grids();
  const double area = grids.knee.step() * grids.wheel.step();
  const double other_area = others.knee.step() * others.wheel.step();
  const double one = share(grids);
  const double other = share(others) * area / other_area;
  std::vector<double> p, q;
  for (int wheel = 0; wheel < grids.wheel.count; ++wheel) {
    for (int knee = 0; knee < grids.knee.count; ++knee) {
      p.push_back(one * (grids.*grid)[p.size()]);
      q.push_back(other * second({grids.knee[knee], grids.wheel[wheel]}).*density);
    }
  }
  return scoring::overlap(p, q);
}

/// The overlap of the densities that are fitted on two setups.
struct OverlapRow {
  std::string simulator;
  std::string estimator;
  const BenchmarkSetup* first;
  const BenchmarkSetup* second;
  double no_contact;
  double contact;
};

Columns<OverlapRow> overlap_columns() {
  using Row = OverlapRow;
  return Columns<Row>()
      .text("simulator", &Row::simulator)
      .text("estimator", &Row::estimator)
      .text("robot", [](const Row& row) { return row.first->robot; })
      .text("sensors", [](const Row& row) { return row.first->sensors; })
      .text("other_robot", [](const Row& row) { return row.second->robot; })
      .text("other_sensors", [](const Row& row) { return row.second->sensors; })
      .metric("no_contact_overlap", &Row::no_contact)
      .metric("contact_overlap", &Row::contact);
}

}  // namespace

void write_overlap(const FittedModels& models, const Evaluation& evaluation,
                   const RunDirectory& directory) {
  const Experiment& experiment = evaluation.request.experiment;
  const auto estimator = std::find_if(experiment.estimators.begin(), experiment.estimators.end(),
                                      [&](const std::string& name) {
                                        return estimator_entry(experiment, name).config.has_value();
                                      });
  if (estimator == experiment.estimators.end()) return;
  const auto setups = benchmark_setups(evaluation.request, evaluation.plan);
  std::vector<OverlapRow> rows;
  for (const std::string& simulator : experiment.simulators) {
    const auto model = [&](const BenchmarkSetup& setup) -> const MeasurementModel& {
      return *models.at(simulator + setup.robot_and_sensors.fit).at(*estimator).grid;
    };
    for (const BenchmarkSetup& first : setups) {
      for (const BenchmarkSetup& second : setups) {
        const auto common = [&](auto density, auto grid) {
          return common_part(model(first), model(second), density, grid);
        };
        rows.push_back({simulator, *estimator, &first, &second,
                        common(&Likelihoods::no_contact, &LikelihoodGrids::no_contact),
                        common(&Likelihoods::contact, &LikelihoodGrids::contact)});
      }
    }
  }
  directory.write_table("density_overlap.csv", overlap_columns(), rows);
}

}  // namespace touchdown::experiments
