#include "experiments/studies/odometry/plan.hpp"

#include "experiments/odometry/contact_sources.hpp"

namespace touchdown::experiments {

std::vector<BenchmarkSetup> odometry_settings(const RunRequest& request, const Plan& plan) {
  if (request.experiment.benchmark) return benchmark_settings(request, plan);
  RunRequest alone = request;
  alone.experiment.benchmark.emplace();
  return benchmark_settings(alone, plan);
}

void add_odometry_study(const RunRequest& request, Plan& plan) {
  for (const BenchmarkSetup& setting : odometry_settings(request, plan)) {
    plan.groups[setting.group].odometry = request.experiment.odometry;
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
