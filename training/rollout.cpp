#include "training/rollout.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "estimator/neural_input.hpp"
#include "experiments/resources.hpp"
#include "experiments/stopped.hpp"
#include "noise/sensor_noise.hpp"
#include "recordings/signals_from.hpp"
#include "scenarios/engine.hpp"

namespace touchdown {

namespace {

/// Runs per environment before giving up; also how far apart the environments' runs are numbered.
constexpr std::int64_t most_runs = 1000;

std::size_t size(int n) { return static_cast<std::size_t>(n); }

/// Writes rows of one environment's column.
class Column {
 public:
  Column(EpisodeBatch& batch, int environment) : batch_(batch), environment_(size(environment)) {}

  void begin_run(int step) { batch_.keep[at(step / batch_.sequence)] = 0.0F; }

  void write(int step, const NeuralInput& input, bool contact, const Eigen::Vector3d& velocity) {
    const std::size_t row = at(step);
    std::copy(input.begin(), input.end(), &batch_.input[row * neural_input_count]);
    batch_.contact[row] = contact ? 1.0F : 0.0F;
    for (int i = 0; i < 3; ++i) {
      batch_.velocity[row * 3 + size(i)] = static_cast<float>(velocity[i]);
    }
  }

 private:
  std::size_t at(int row) const { return size(row) * size(batch_.environments) + environment_; }

  EpisodeBatch& batch_;
  std::size_t environment_;
};

ContactSequence robot_contact(const Recording& recording, const RolloutConfig& config) {
  const auto wheels = contact_labels(recording, config.labels);
  return config.contact == RobotContact::any_wheel ? any_wheel(wheels) : both_wheels(wheels);
}

/// Writes a run's rows from `first` on into the column from `step` on, whole sequences only.
/// Returns the step behind the last one.
int write_run(const Recording& recording, int first, const RolloutConfig& config, int step,
              Column& column) {
  const int rows = std::min(static_cast<int>(recording.steps()) - first, config.steps - step);
  const int whole = rows / config.sequence * config.sequence;
  if (whole <= 0) return step;
  const ContactSequence contact = robot_contact(recording, config);
  const NoiseKey key{.seed = recording.info.seed,
                     .run = static_cast<std::uint64_t>(recording.info.run)};
  column.begin_run(step);
  for (int i = 0; i < whole; ++i) {
    const std::size_t k = size(first + i);
    const double command = k > 0 ? ground_velocity_command(recording.action[k - 1]) : 0.0;
    const Observation heard = with_noise(recording.observation[k], key, k, config.noise);
    const GroundTruth& truth = recording.truth[k];
    column.write(step + i, neural_input(signals_from(heard, command)), contact[k] != 0,
                 truth.base_orientation.conjugate() * truth.imu_linear_velocity);
  }
  return step + whole;
}

void roll_out_environment(const RolloutConfig& config, Scenario scenario, std::uint64_t seed,
                          std::int64_t number, Column column) {
  const double period = 1e-6 * static_cast<double>(config.control_step_us);
  const int skip = static_cast<int>(std::lround(config.skip / period));
  int step = 0;
  for (std::int64_t attempt = 0; step < config.steps; ++attempt) {
    if (attempt == most_runs) {
      throw InputError(fmt::format("{}: in {} runs the robot did not stay up for {} steps",
                                   config.scenario, most_runs, config.steps));
    }
    scenario.end.duration = (skip + config.steps - step) * period;
    const std::int64_t run = number * most_runs + attempt;
    const Recording recording = play(perturbed(scenario, seed, run), config.simulator, seed, run);
    if (recording.info.outcome == Outcome::diverged) continue;
    step = write_run(recording, skip, config, step, column);
  }
}

}  // namespace

EpisodeBatch roll_out(const RolloutConfig& config, const Scenario& scenario, std::uint64_t seed,
                      std::int64_t first_environment, int environments,
                      const RolloutProgress& progress) {
  EpisodeBatch batch;
  batch.steps = config.steps;
  batch.environments = environments;
  batch.sequence = config.sequence;
  const std::size_t rows = size(config.steps) * size(environments);
  batch.input.resize(rows * neural_input_count);
  batch.contact.resize(rows);
  batch.velocity.resize(rows * 3);
  batch.keep.assign(rows / size(config.sequence), 1.0F);
  tbb::parallel_for(0, environments, [&](int environment) {
    roll_out_environment(config, scenario, seed, first_environment + environment,
                         Column(batch, environment));
    if (!progress()) throw Stopped();
  });
  return batch;
}

Scenario rollout_scenario(const RolloutConfig& config) {
  Scenario scenario = load_scenario(find_resource(config.scenario));
  scenario.robot = find_resource(scenario.robot);
  scenario.simulation.steps.control_us = config.control_step_us;
  if (config.control_step_us % scenario.simulation.steps.physics_us != 0) {
    throw InputError(fmt::format("{}: control_step_us: expected a multiple of physics_step_us, {}",
                                 config.scenario, scenario.simulation.steps.physics_us));
  }
  return scenario;
}

}  // namespace touchdown
