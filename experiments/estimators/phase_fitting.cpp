#include "experiments/estimators/phase_fitting.hpp"

#include <algorithm>
#include <cmath>
#include <list>
#include <vector>

#include "core/error.hpp"
#include "core/yaml.hpp"
#include "estimator/signal_guard.hpp"
#include "experiments/estimators/fit_runs.hpp"
#include "experiments/signals/reserved_seeds.hpp"

namespace touchdown::experiments {

namespace {

/// Whether the step has all signals that a fit uses.
bool is_whole(const Signals& step) {
  return std::isfinite(step.vertical_acceleration) && has_torques(step.leg[0]) &&
         has_torques(step.leg[1]);
}

/// The signals with all values that a fit uses finite: a missing value repeats the previous one.
std::vector<Signals> without_gaps(std::vector<Signals> filled) {
  const auto fill = [&](const auto& value_of) {
    double last = 0.0;
    for (Signals& step : filled) {
      double& value = value_of(step);
      if (!std::isfinite(value)) value = last;
      last = value;
    }
  };
  fill([](Signals& step) -> double& { return step.vertical_acceleration; });
  for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
    fill([&](Signals& step) -> double& { return step.leg[leg].knee.torque; });
    fill([&](Signals& step) -> double& { return step.leg[leg].wheel.torque; });
  }
  return filled;
}

}  // namespace

bool may_be_held(const recordings::RecordingInfo& info) {
  if (info.scenario_yaml.empty()) return false;
  const YAML::Node scenario =
      YamlDocument::parse(info.scenario_yaml, info.scenario + " (in the log)").root();
  return std::any_of(scenario.begin(), scenario.end(), [](const auto& entry) {
    const auto key = entry.first.template as<std::string>();
    return key == "tether" || key == "forces";
  });
}

recordings::PhaseModelFile fit_phases(std::span<const RunSignals* const> runs,
                                      const PhaseFitConfig& config, double skip,
                                      const std::function<void()>& before_density) {
  if (runs.empty()) throw InputError("phase filter: there is no run to fit to");
  std::vector<PhaseFitRun> segments;
  std::list<std::vector<Signals>> filled_runs;
  for (const RunSignals* run : runs) {
    check_may_be_fitted(run->info);
    if (run->info.control_period_us != runs.front()->info.control_period_us) {
      throw InputError("phase filter: fitted runs must share one control period");
    }
    const bool has_gaps = !std::all_of(run->signals.begin(), run->signals.end(), is_whole);
    if (has_gaps) filled_runs.push_back(without_gaps(run->signals));
    segments.push_back({has_gaps ? filled_runs.back() : run->signals,
                        {WheelContact(run->contact[0]), WheelContact(run->contact[1])},
                        may_be_held(run->info),
                        {run->normal_force[0], run->normal_force[1]},
                        skipped_steps(*run, skip)});
  }
  return {fit_phase_model(segments, 1.0 / period_of(*runs.front()), config, before_density),
          provenance_of("phase", runs, skip)};
}

}  // namespace touchdown::experiments
