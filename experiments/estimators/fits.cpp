#include "experiments/estimators/fits.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/yaml.hpp"
#include "estimator/bayes/measurement_fit.hpp"
#include "experiments/signals/run_signals.hpp"
#include "scoring/score.hpp"

namespace touchdown::experiments {

MeasurementModel fit_torques(FitRuns runs, double skip, const MeasurementConfig& config) {
  std::vector<TorqueSample> contact;
  std::vector<TorqueSample> no_contact;
  for (const RunSignals* run : runs) {
    const double period = run->period();
    const std::size_t first =
        scoring::first_scored_step(run->info.control_period_us, {.skip = skip});
    for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
      // Torques are processed as in the filter, and sorted by their wheel's label.
      TorqueChannel channel(config.torque, static_cast<Side>(leg), 1.0 / period);
      for (std::size_t k = 0; k < run->steps(); ++k) {
        if (!has_torques(run->signals[k].leg[leg])) continue;  // the filter ignores these, too
        const TorqueSample sample = channel.update(run->signals[k].leg[leg]);
        if (k >= first) (run->contact[leg][k] != 0 ? contact : no_contact).push_back(sample);
      }
    }
  }
  return fit_measurement_model(contact, no_contact, config.fit);
}

std::filesystem::path robot_file_of(const logs::RecordingInfo& log) {
  if (log.scenario_yaml.empty()) return {};
  const YamlDocument scenario =
      YamlDocument::parse(log.scenario_yaml, log.scenario + " (in the log)");
  const YAML::Node robot = scenario.root()["robot"];
  return robot.IsDefined() && robot.IsScalar() ? robot.Scalar() : std::string();
}

std::string robot_of(const logs::RecordingInfo& info) {
  return info.scenario_yaml.empty() ? info.robot : robot_file_of(info).stem().string();
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

FittedTo fitted_to(FitRuns runs, double skip) {
  FittedTo fitted;
  for (const RunSignals* run : runs) {
    fitted.add(run->info);
    const double rest = std::max(0.0, skip - run->start);
    const auto skipped = static_cast<std::size_t>(std::llround(rest / run->period()));
    fitted.seconds +=
        static_cast<double>(run->steps() - std::min(run->steps(), skipped)) * run->period();
  }
  return fitted;
}

}  // namespace touchdown::experiments
