#include "experiments/needs.hpp"

#include <algorithm>
#include <cmath>
#include <sys/sysinfo.h>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "experiments/studies/phase_study/plan.hpp"

namespace touchdown::experiments {

namespace {

/// Memory of a planned run with its scenario's terrain and scripts.
constexpr double planned_bytes = sizeof(PlannedRun) + 512.0;
/// Memory per step of a rollout.
constexpr double signal_step_bytes =
    sizeof(Signals) + sizeof(Eigen::Vector3d) +
    static_cast<double>(models::wheel_count) * (sizeof(double) + 1.0);

/// Additional memory per step where odometry is studied.
constexpr double motion_step_bytes = sizeof(Eigen::Vector3d) + sizeof(scoring::TimedPose);

/// Adds runs of a scenario. Each is evaluated with `seeds` noise seeds, and its signals are kept
/// once for each of `sensors` sensor models.
void add_runs(Needs& needs, const scenarios::Scenario& scenario, double runs, double seeds,
              double sensors = 1.0) {
  // Runs that end at a position take about half of their longest duration.
  const double share = std::isfinite(scenario.end.x) ? 0.5 : 1.0;
  const double seconds = runs * share * scenario.end.duration;
  needs.runs += runs;
  needs.parts += runs * seeds * sensors;
  needs.seconds += seconds;
  needs.steps +=
      sensors * seconds / (1e-6 * static_cast<double>(scenario.simulation.steps.control_us));
}

}  // namespace

Needs needs_of(const RunRequest& request) {
  const Experiment& experiment = request.experiment;
  const auto engines = static_cast<double>(experiment.simulators.size());
  const double seeds = experiment.noise.seeds;
  Needs needs;
  for (const std::string& file : experiment.fit.scenarios) {
    add_runs(needs, scenario_of(request, file).scenario, engines * experiment.fit.runs, 0.0);
  }
  for (const TrainingSegments& segments : experiment.training_segments) {
    add_runs(needs, scenario_of(request, segments.scenario).scenario, engines * segments.runs, 0.0);
  }
  double sensors = 1.0;
  for (const SensorFactor& factor : experiment.sweep) {
    sensors += static_cast<double>(factor.values.size());
  }
  if (experiment.benchmark) {
    // Each robot may run differently, and each combination of robot and sensors has fitted runs.
    const auto robots = 1.0 + static_cast<double>(experiment.benchmark->robots.size());
    const auto profiles = 1.0 + static_cast<double>(experiment.benchmark->sensors.size());
    for (const std::string& file : experiment.fit.scenarios) {
      add_runs(needs, scenario_of(request, file).scenario,
               (robots * profiles - 1.0) * engines * experiment.fit.runs, 0.0);
    }
    sensors += robots * profiles - 1.0;
  }
  for (const std::string& file : experiment.test.scenarios) {
    add_runs(needs, scenario_of(request, file).scenario, engines * experiment.test.runs, seeds,
             sensors);
  }
  const scenarios::Scenario& first =
      scenario_of(request, experiment.test.scenarios.front()).scenario;
  if (experiment.cross_simulator) {
    double variations = 0.0;
    for (const Factor& factor : experiment.cross_simulator->factors) {
      // One of the values may be the nominal one, which the experiment's own runs cover.
      variations += static_cast<double>((factor.values.size() - 1) * factor.simulators.size());
    }
    add_runs(needs, first, variations * experiment.cross_simulator->sensitivity_runs, seeds);
  }
  if (experiment.phase_study) {
    needs.parts += engines * more_scenes.size() * experiment.test.runs * seeds;
  }
  return needs;
}

double memory_of_machine() {
  struct sysinfo machine = {};
  if (::sysinfo(&machine) != 0) return HUGE_VAL;
  return static_cast<double>(machine.totalram + machine.totalswap) * machine.mem_unit;
}

void require_memory(const RunRequest& request, double share_of_runs, double memory) {
  const Needs needs = needs_of(request);
  const double planned = needs.runs * planned_bytes + needs.parts * sizeof(Task);
  const double step = signal_step_bytes + (request.experiment.odometry ? motion_step_bytes : 0.0);
  const double rollout = share_of_runs * needs.steps * step;
  if (planned + rollout <= memory) return;
  const Experiment& experiment = request.experiment;
  const bool too_long = rollout > planned;
  throw Error(fmt::format(
      "{}: {:.0f} runs of {:.0f} s together and {:.0f} parts (test.runs={}, fit.runs={}, "
      "noise.seeds={}) need at least {:.1f} GB of memory, and this machine has {:.1f} GB: {}",
      experiment.name, needs.runs, needs.seconds, needs.parts, experiment.test.runs,
      experiment.fit.runs, experiment.noise.seeds, 1e-9 * (planned + rollout), 1e-9 * memory,
      too_long ? "lower test.runs or fit.runs, or compute it in shards (--shard)"
               : "lower test.runs or noise.seeds"));
}

double bytes_of_parts(const Plan& plan) {
  constexpr double block = 4096.0;  // of a disk
  constexpr double head = 256.0;
  std::vector<double> of_group;
  for (const RunGroup& group : plan.groups) {
    double estimators = 0.0;
    for (const Condition& condition : group.conditions) {
      const auto tested =
          static_cast<double>(tested_on(group.conditions, condition.test_simulator).size());
      estimators = std::max(estimators, tested);
    }
    const auto counted = static_cast<double>(group.counted.size() + group.disturbed.size());
    const double contact_sources =
        group.odometry ? estimators + 1.0 + static_cast<double>(group.odometry->delay.size()) : 0.0;
    const std::size_t points =
        group.operating_points ? 1 + points_of(*group.operating_points).size() : 0;
    const double bytes =
        head + contact_sources * sizeof(scoring::TrajectoryScore) +
        estimators *
            (static_cast<double>(group.scored.size() * points) * sizeof(scoring::OperatingScore) +
             counted * sizeof(scoring::Classification) +
             static_cast<double>(group.scored.size()) *
                 (sizeof(scoring::RobotScore) +
                  (group.has_extended_scores ? sizeof(scoring::ExtendedScore) : 0)));
    of_group.push_back(block * std::ceil(bytes / block));
  }
  double bytes = 0.0;
  for (const Task& task : plan.tasks) bytes += of_group[plan.runs[task.run].group];
  return bytes;
}

}  // namespace touchdown::experiments
