#include "experiments/studies/odometry/plan.hpp"

#include "experiments/odometry/contact_sources.hpp"

namespace touchdown::experiments {

std::vector<BenchmarkSetup> odometry_setups(const RunRequest& request, const Plan& plan) {
  if (request.experiment.benchmark) return benchmark_setups(request, plan);
  RunRequest alone = request;
  alone.experiment.benchmark.emplace();
  return benchmark_setups(alone, plan);
}

void add_odometry_study(const RunRequest& request, Plan& plan) {
  for (const BenchmarkSetup& setup : odometry_setups(request, plan)) {
    plan.groups[setup.group].odometry = request.experiment.odometry;
  }
}

std::vector<std::string> contact_sources_of(const RunGroup& group, const std::string& simulator) {
  std::vector<std::string> names = oracle_names(*group.odometry);
  for (const Condition& condition : tested_on(group.conditions, simulator)) {
    if (group.feeds_odometry(condition)) names.push_back(contact_name(condition.estimator));
  }
  return names;
}

}  // namespace touchdown::experiments
