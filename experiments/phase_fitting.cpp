#include "experiments/phase_fitting.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include "core/error.hpp"
#include "experiments/reserved_seeds.hpp"

namespace touchdown {

namespace {

double period_of(const HeardRun& run) {
  return 1e-6 * static_cast<double>(run.info.control_period_us);
}

std::size_t skipped_steps(const HeardRun& run, double skip) {
  return std::min(run.steps(), static_cast<std::size_t>(std::llround(skip / period_of(run))));
}

}  // namespace

bool may_be_held(const RecordingInfo& info) {
  if (info.scenario_yaml.empty()) return false;
  const YAML::Node scenario = YAML::Load(info.scenario_yaml);
  return std::any_of(scenario.begin(), scenario.end(), [](const auto& entry) {
    const auto key = entry.first.template as<std::string>();
    return key == "tether" || key == "forces" || key == "guide";
  });
}

PhaseModel fit_phases(std::span<const HeardRun* const> runs, const PhaseFitConfig& config,
                      double skip, const std::function<void()>& before_density) {
  if (runs.empty()) throw InputError("phase filter: there is no run to fit to");
  std::vector<PhaseFitRun> pieces;
  for (const HeardRun* run : runs) {
    check_may_be_fitted(run->info);
    if (run->info.control_period_us != runs.front()->info.control_period_us) {
      throw InputError("phase filter: fitted runs must share one control period");
    }
    pieces.push_back({run->signals,
                      {WheelContact(run->contact[0]), WheelContact(run->contact[1])},
                      may_be_held(run->info),
                      {run->normal_force[0], run->normal_force[1]},
                      skipped_steps(*run, skip)});
  }
  return fit_phase_model(pieces, 1.0 / period_of(*runs.front()), config, before_density);
}

ModelProvenance provenance_of(std::span<const HeardRun* const> runs, double skip) {
  std::set<std::string> scenarios;
  std::set<std::string> simulators;
  std::set<std::string> drawn;
  double seconds = 0.0;
  for (const HeardRun* run : runs) {
    scenarios.insert(run->info.scenario);
    simulators.insert(run->info.simulator);
    drawn.insert(fmt::format("{}:{}", run->info.seed, run->info.run));
    seconds += static_cast<double>(run->steps() - skipped_steps(*run, skip)) * period_of(*run);
  }
  return {{"estimator", "phase"},
          {"scenarios", fmt::format("{}", fmt::join(scenarios, ", "))},
          {"simulators", fmt::format("{}", fmt::join(simulators, ", "))},
          {"seed:run", fmt::format("{}", fmt::join(drawn, ", "))},
          {"seconds", fmt::format("{:.3f}", seconds)}};
}

}  // namespace touchdown
