#include "apps/training/rollout.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/random.hpp"
#include "estimator/neural/input.hpp"
#include "logs/signals_from.hpp"
#include "noise/reported_signals.hpp"
#include "noise/sensor_noise.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/generation/generate.hpp"

namespace touchdown::training {

namespace {

/// Attempts per run before giving up, and the distance of the runs' numbers in the stream of draws.
constexpr std::int64_t most_tries = 100;
constexpr std::int64_t draws_per_run = 1000;

std::size_t size(int n) { return static_cast<std::size_t>(n); }

/// The episodes that one run fills: consecutive environments, as one long sequence of steps.
struct RunSlice {
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

scoring::ContactSequence robot_contact(const logs::Recording& recording,
                                       const RolloutConfig& config) {
  const auto wheels = scoring::contact_labels(recording, config.labels);
  return config.contact == RobotContact::any_wheel ? scoring::any_wheel(wheels)
                                                   : scoring::both_wheels(wheels);
}

noise::SensorNoise levels_of(const RolloutConfig& config, const noise::NoiseKey& key) {
  constexpr std::uint64_t share_stream = 0x7368617265;  // "share"
  const double share = std::lerp(config.noise_share[0], config.noise_share[1],
                                 uniform01(key.seed, share_stream, key.run));
  noise::SensorNoise levels = config.noise;
  for (double* level : {&levels.acceleration, &levels.joint_position, &levels.joint_velocity}) {
    *level *= share;
  }
  return levels;
}

/// The network's inputs of a run, with their rows in the recording.
struct RunInputs {
  std::vector<NeuralInput> input;
  std::vector<std::size_t> row;
};

RunInputs inputs_of(const logs::Recording& recording, const RolloutConfig& config,
                    const noise::SensorProfile& sensors) {
  const noise::NoiseKey key{.seed = recording.info.seed,
                            .run = static_cast<std::uint64_t>(recording.info.run)};
  const noise::SensorNoise levels = levels_of(config, key);
  std::vector<models::Observation> observations = recording.observation;
  noise::report_through(sensors, key, 1e-6 * static_cast<double>(config.control_step_us),
                        observations);
  RunInputs inputs;
  NeuralInputSampler sampler(config.stride());
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const double command = k > 0 ? logs::ground_velocity_command(recording.action[k - 1]) : 0.0;
    const Signals signals =
        logs::signals_from(noise::with_noise(observations[k], key, k, levels), command);
    if (!neural_input(signals).allFinite()) {
      sampler.skip();
    } else if (sampler.add(signals)) {
      inputs.input.push_back(sampler.input());
      inputs.row.push_back(k);
    }
  }
  return inputs;
}

/// Writes the inputs of a run from the network's step `first` on into the slice from `step` on, in
/// whole sequences. Returns the step after the last one.
int write_rows(const logs::Recording& recording, const RunInputs& inputs, int first,
               const RolloutConfig& config, int step, RunSlice& slice) {
  const int steps = std::min(static_cast<int>(inputs.row.size()) - first, slice.steps() - step);
  const int whole = steps / config.sequence * config.sequence;
  if (whole <= 0) return step;
  const scoring::ContactSequence contact = robot_contact(recording, config);
  slice.begin_run(step);
  for (int i = 0; i < whole; ++i) {
    const std::size_t k = inputs.row[size(first + i)];
    const models::GroundTruth& truth = recording.truth[k];
    slice.write(step + i, inputs.input[size(first + i)], contact[k] != 0,
                truth.base_orientation.conjugate() * truth.imu_linear_velocity);
  }
  return step + whole;
}

void roll_out_run(const RolloutConfig& config, const RolloutScenes::Scene& scene,
                  const noise::SensorProfile& sensors, std::uint64_t seed, std::int64_t number,
                  RunSlice slice) {
  const double period = config.period();
  const int skip = static_cast<int>(std::lround(config.skip / period));
  int step = 0;
  for (std::int64_t attempt = 0; step < slice.steps(); ++attempt) {
    if (attempt == most_tries) {
      throw InputError(fmt::format("{}: the robot fell {} times within {:.0f} s",
                                   scene.scenario.name, most_tries, period * slice.steps()));
    }
    const std::int64_t run = number * draws_per_run + attempt;
    scenarios::Scenario drawn = scenarios::perturbed(scene.scenario, seed, run);
    drawn.end.duration = (skip + slice.steps() - step) * period;
    const logs::Recording recording = scenarios::play(drawn, scene.simulator, seed, run);
    if (recording.info.outcome == logs::Outcome::diverged) continue;
    step = write_rows(recording, inputs_of(recording, config, sensors), skip, config, step, slice);
  }
}

/// The first environment of every run, for `environments` episodes.
std::vector<int> first_environments(const RolloutConfig& config, const RolloutScenes& scenes,
                                    int environments) {
  std::vector<int> first;
  for (int next = 0; next < environments;) {
    first.push_back(next);
    next +=
        episodes_per_run(config, scenes.scenes[(first.size() - 1) % scenes.scenes.size()].scenario);
  }
  return first;
}

RolloutScenes scenes_of(const RolloutConfig& config, const std::vector<std::string>& files) {
  RolloutScenes found;
  for (const std::string& simulator : config.simulators) {
    for (const std::string& file : files) {
      scenarios::Scenario scenario = scenarios::find_scenario(file);
      scenario.simulation.steps.control_us = config.control_step_us;
      if (config.control_step_us % scenario.simulation.steps.physics_us != 0) {
        throw InputError(
            fmt::format("{}: control_step_us: expected a multiple of physics_step_us, {}", file,
                        scenario.simulation.steps.physics_us));
      }
      found.scenes.push_back({std::move(scenario), simulator});
    }
  }
  if (!config.sensors.empty()) found.sensors = noise::find_sensor_profile(config.sensors);
  return found;
}

}  // namespace

int episodes_per_run(const RolloutConfig& config, const scenarios::Scenario& scenario) {
  const double episode = config.period() * config.steps;
  return std::max(1, static_cast<int>((scenario.end.duration - config.skip) / episode + 1e-6));
}

int runs_for(const RolloutConfig& config, const RolloutScenes& scenes, int environments) {
  return static_cast<int>(first_environments(config, scenes, environments).size());
}

EpisodeBatch roll_out(const RolloutConfig& config, const RolloutScenes& scenes, std::uint64_t seed,
                      std::int64_t first_run, int environments, const RolloutProgress& progress) {
  EpisodeBatch batch;
  batch.steps = config.steps;
  batch.environments = environments;
  batch.sequence = config.sequence;
  const std::size_t rows = size(config.steps) * size(environments);
  batch.input.resize(rows * neural_input_count);
  batch.contact.resize(rows);
  batch.velocity.resize(rows * 3);
  batch.keep.assign(rows / size(config.sequence), 1.0F);
  const std::vector<int> first = first_environments(config, scenes, environments);
  tbb::parallel_for(std::size_t{0}, first.size(), [&](std::size_t run) {
    const int next = run + 1 < first.size() ? first[run + 1] : environments;
    roll_out_run(config, scenes.scenes[run % scenes.scenes.size()], scenes.sensors, seed,
                 first_run + static_cast<std::int64_t>(run),
                 {batch, first[run], next - first[run]});
    if (!progress()) throw Stopped();
  });
  return batch;
}

RolloutScenes training_scenes(const RolloutConfig& config) {
  return scenes_of(config, config.scenarios);
}

RolloutScenes validation_scenes(const RolloutConfig& config) {
  const bool own = !config.validation_scenarios.empty();
  return scenes_of(config, own ? config.validation_scenarios : config.scenarios);
}

}  // namespace touchdown::training
