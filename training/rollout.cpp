#include "training/rollout.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/resources.hpp"
#include "estimator/neural/input.hpp"
#include "noise/sensor_noise.hpp"
#include "recordings/signals_from.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/scenario_file.hpp"

namespace touchdown::training {

namespace {

/// Tries per run before giving up, and how far apart the runs' draws are numbered.
constexpr std::int64_t most_tries = 100;
constexpr std::int64_t draws_per_run = 1000;

std::size_t size(int n) { return static_cast<std::size_t>(n); }

/// The episodes that one run fills: consecutive environments, as one long row of steps.
struct Stretch {
  EpisodeBatch& batch;
  int first_environment;
  int environments;

  int steps() const { return batch.steps * environments; }

  void begin_run(int step) { batch.keep[at(step % batch.steps / batch.sequence, step)] = 0.0F; }

  void write(int step, const NeuralInput& input, bool contact, const Eigen::Vector3d& velocity) {
    const std::size_t row = at(step % batch.steps, step);
    std::copy(input.begin(), input.end(), &batch.input[row * neural_input_count]);
    batch.contact[row] = contact ? 1.0F : 0.0F;
    for (int i = 0; i < 3; ++i) {
      batch.velocity[row * 3 + size(i)] = static_cast<float>(velocity[i]);
    }
  }

 private:
  std::size_t at(int row, int step) const {
    return size(row) * size(batch.environments) + size(first_environment + step / batch.steps);
  }
};

scoring::ContactSequence robot_contact(const recordings::Recording& recording,
                                       const RolloutConfig& config) {
  const auto wheels = scoring::contact_labels(recording, config.labels);
  return config.contact == RobotContact::any_wheel ? scoring::any_wheel(wheels)
                                                   : scoring::both_wheels(wheels);
}

/// Writes a recording's rows from `first` on into the stretch from `step` on, whole sequences only.
/// Returns the step behind the last one.
int write_rows(const recordings::Recording& recording, int first, const RolloutConfig& config,
               int step, Stretch& stretch) {
  const int rows = std::min(static_cast<int>(recording.steps()) - first, stretch.steps() - step);
  const int whole = rows / config.sequence * config.sequence;
  if (whole <= 0) return step;
  const scoring::ContactSequence contact = robot_contact(recording, config);
  const noise::NoiseKey key{.seed = recording.info.seed,
                            .run = static_cast<std::uint64_t>(recording.info.run)};
  stretch.begin_run(step);
  for (int i = 0; i < whole; ++i) {
    const std::size_t k = size(first + i);
    const double command =
        k > 0 ? recordings::ground_velocity_command(recording.action[k - 1]) : 0.0;
    const models::Observation heard =
        noise::with_noise(recording.observation[k], key, k, config.noise);
    const models::GroundTruth& truth = recording.truth[k];
    stretch.write(step + i, neural_input(recordings::signals_from(heard, command)), contact[k] != 0,
                  truth.base_orientation.conjugate() * truth.imu_linear_velocity);
  }
  return step + whole;
}

void roll_out_run(const RolloutConfig& config, const scenarios::Scenario& scenario,
                  std::uint64_t seed, std::int64_t number, Stretch stretch) {
  const double period = config.period();
  const int skip = static_cast<int>(std::lround(config.skip / period));
  int step = 0;
  for (std::int64_t attempt = 0; step < stretch.steps(); ++attempt) {
    if (attempt == most_tries) {
      throw InputError(fmt::format("{}: the robot fell {} times within {:.0f} s", config.scenario,
                                   most_tries, period * stretch.steps()));
    }
    const std::int64_t run = number * draws_per_run + attempt;
    scenarios::Scenario drawn = scenarios::perturbed(scenario, seed, run);
    drawn.end.duration = (skip + stretch.steps() - step) * period;
    const recordings::Recording recording = scenarios::play(drawn, config.simulator, seed, run);
    if (recording.info.outcome == recordings::Outcome::diverged) continue;
    step = write_rows(recording, skip, config, step, stretch);
  }
}

}  // namespace

int episodes_per_run(const RolloutConfig& config, const scenarios::Scenario& scenario) {
  const double episode = config.period() * config.steps;
  return std::max(1, static_cast<int>((scenario.end.duration - config.skip) / episode + 1e-6));
}

int runs_for(const RolloutConfig& config, const scenarios::Scenario& scenario, int environments) {
  const int each = episodes_per_run(config, scenario);
  return (environments + each - 1) / each;
}

EpisodeBatch roll_out(const RolloutConfig& config, const scenarios::Scenario& scenario,
                      std::uint64_t seed, std::int64_t first_run, int environments,
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
  const int each = episodes_per_run(config, scenario);
  tbb::parallel_for(0, runs_for(config, scenario, environments), [&](int run) {
    roll_out_run(config, scenario, seed, first_run + run,
                 {batch, run * each, std::min(each, environments - run * each)});
    if (!progress()) throw Stopped();
  });
  return batch;
}

scenarios::Scenario rollout_scenario(const RolloutConfig& config) {
  scenarios::Scenario scenario = scenarios::find_scenario(config.scenario);
  scenario.simulation.steps.control_us = config.control_step_us;
  if (config.control_step_us % scenario.simulation.steps.physics_us != 0) {
    throw InputError(fmt::format("{}: control_step_us: expected a multiple of physics_step_us, {}",
                                 config.scenario, scenario.simulation.steps.physics_us));
  }
  return scenario;
}

}  // namespace touchdown::training
