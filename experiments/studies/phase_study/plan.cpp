#include "experiments/studies/phase_study/plan.hpp"

#include <fmt/format.h>

#include "scenarios/perturbation.hpp"
#include "scenarios/scenario_file.hpp"

namespace touchdown::experiments {

namespace {

/// The test runs of a scene in every engine, at 1 kHz.
void plan_test_runs(const Experiment& experiment, const std::string& scene, std::size_t group,
                    Plan& plan) {
  scenarios::Scenario scenario = scenarios::find_scenario("scenarios/" + scene + ".yaml");
  scenario.simulation.steps.control_us = 1000;
  for (const std::string& simulator : experiment.simulators) {
    for (int run = 0; run < experiment.test.runs; ++run) {
      plan.runs.push_back({.role = RunRole::test,
                           .simulator = simulator,
                           .scenario = scenarios::perturbed(scenario, experiment.seed, run),
                           .run = run,
                           .file = recording_name(simulator, scene, to_text(RunRole::test), run),
                           .seed = experiment.seed,
                           .group = group});
    }
  }
}

std::vector<DisturbedCell> disturbed_cells() {
  const noise::NoiseCell noise{0.25, 1.0};
  noise::NoiseCell encoders = noise;
  encoders.joint_position = 0.001;
  encoders.joint_velocity = 0.1;
  noise::NoiseCell bad_encoders = noise;
  bad_encoders.joint_position = 0.01;
  bad_encoders.joint_velocity = 1.0;
  return {{noise, {.imu_delay = 10}},
          {noise, {.imu_delay = 5}},
          {noise, {.heavy_tails = true}},
          {noise, {}},
          {noise, {.torque_bias = 0.2}},
          {noise, {.torque_gain = 1.2}},
          {encoders, {}},
          {bad_encoders, {}}};
}

}  // namespace

std::string segments_fit(int segments) { return fmt::format("_{}_pieces", segments); }

void add_phase_study(const RunRequest& request, Plan& plan) {
  const Experiment& experiment = request.experiment;
  plan_segment_runs(request, {}, 0, experiment.training_segments.front().runs,
                    learning_curve.back(), plan);
  RunGroup& stairs = plan.groups.front();
  RunGroup scene{.name = {}, .conditions = {}, .counted = {}, .scored = {}};
  scene.has_extended_scores = stairs.has_extended_scores = true;
  stairs.disturbed = disturbed_cells();
  const noise::NoiseGridConfig& noise = experiment.noise;
  for (std::size_t i = 0; i < std::min(noise.torque.size(), noise.accelerometer.size()); ++i) {
    scene.scored.push_back({noise.torque[i], noise.accelerometer[i]});
  }
  for (const std::string& simulator : experiment.simulators) {
    for (const std::string& other : experiment.simulators) {
      if (other != simulator) stairs.conditions.push_back({other, simulator, "phase"});
    }
    for (const int segments : learning_curve) {
      stairs.conditions.push_back({simulator, simulator, "phase", segments_fit(segments)});
    }
    for (const char* estimator : compared_estimators) {
      scene.conditions.push_back({simulator, simulator, estimator});
    }
  }
  for (const char* name : more_scenes) {
    scene.name = name;
    plan_test_runs(experiment, name, plan.groups.size(), plan);
    plan.groups.push_back(scene);
  }

  // The study keeps its original noise draws.
  plan.tasks.clear();
  plan_tasks(experiment, 0, plan);
  for (Task& task : plan.tasks) {
    const PlannedRun& run = plan.runs[task.run];
    task.noise = {.seed = 7000 + static_cast<std::uint64_t>(task.seed),
                  .run = static_cast<std::uint64_t>(run.run) + 100'000 * run.seed};
  }
}

}  // namespace touchdown::experiments
