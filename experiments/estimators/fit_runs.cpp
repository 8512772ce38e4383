#include "experiments/estimators/fit_runs.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/yaml.hpp"
#include "experiments/signals/run_signals.hpp"

namespace touchdown::experiments {

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
  if (info.simulator.empty()) return;
  scenarios.insert(info.scenario);
  simulators.insert(info.simulator);
  draws.insert(fmt::format("{}:{}", info.seed, info.run));
}

ModelArray FittedTo::provenance(std::string_view estimator) const {
  std::string text = fmt::format("estimator: {}\nseconds: {:.3f}\n", estimator, seconds);
  const auto add = [&](std::string_view key, const std::set<std::string>& values) {
    if (!values.empty()) text += fmt::format("{}: {}\n", key, fmt::join(values, ", "));
  };
  add("scenarios", scenarios);
  add("simulators", simulators);
  add("seed:run", draws);
  add("logs", logs);
  return array_of_text(text);
}

std::size_t skipped_steps(const RunSignals& run, double skip) {
  const double rest = std::max(0.0, skip - run.start);
  return std::min(run.steps(), static_cast<std::size_t>(std::llround(rest / run.period())));
}

FittedTo fitted_to(std::span<const RunSignals* const> runs, double skip) {
  FittedTo fitted;
  for (const RunSignals* run : runs) {
    fitted.add(run->info);
    fitted.seconds += static_cast<double>(run->steps() - skipped_steps(*run, skip)) * run->period();
  }
  return fitted;
}

}  // namespace touchdown::experiments
