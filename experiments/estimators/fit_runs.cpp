#include "experiments/estimators/fit_runs.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/yaml.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

FitRuns FitRuns::together() const {
  FitRuns all = *this;
  all.whole.insert(all.whole.end(), segments.begin(), segments.end());
  all.segments.clear();
  return all;
}

LegGeometry legs_of(const FitRuns& runs) {
  for (const auto* group : {&runs.whole, &runs.segments}) {
    if (!group->empty()) return group->front()->legs;
  }
  return {};
}

std::string robot_of(const logs::RecordingInfo& info) {
  if (info.scenario_yaml.empty()) return info.robot;
  const YamlDocument scenario =
      YamlDocument::parse(info.scenario_yaml, info.scenario + " (in the log)");
  const YAML::Node robot = scenario.root()["robot"];
  return robot.IsDefined() && robot.IsScalar()
             ? std::filesystem::path(robot.Scalar()).stem().string()
             : "";
}

void FittedTo::add(const logs::RecordingInfo& info) {
  if (sample_rate == 0.0) sample_rate = 1e6 / static_cast<double>(info.control_period_us);
  if (const std::string robot = robot_of(info); !robot.empty()) robots.insert(robot);
}

std::size_t skipped_steps(const RunSignals& run, double skip) {
  const double rest = std::max(0.0, skip - run.start);
  return std::min(run.steps(), static_cast<std::size_t>(std::llround(rest / run.period())));
}

ModelArray provenance_of(std::string_view estimator, std::span<const RunSignals* const> runs,
                         double skip) {
  std::set<std::string> scenarios;
  std::set<std::string> simulators;
  std::set<std::string> drawn;
  double seconds = 0.0;
  for (const RunSignals* run : runs) {
    scenarios.insert(run->info.scenario);
    simulators.insert(run->info.simulator);
    drawn.insert(fmt::format("{}:{}", run->info.seed, run->info.run));
    seconds += static_cast<double>(run->steps() - skipped_steps(*run, skip)) * run->period();
  }
  return array_of_text(fmt::format(
      "estimator: {}\nscenarios: {}\nseconds: {:.3f}\nseed:run: {}\nsimulators: {}\n", estimator,
      fmt::join(scenarios, ", "), seconds, fmt::join(drawn, ", "), fmt::join(simulators, ", ")));
}

}  // namespace touchdown::experiments
