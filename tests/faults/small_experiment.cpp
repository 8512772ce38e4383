#include "tests/faults/small_experiment.hpp"

#include <cstdlib>
#include <fstream>

#include "tests/cli/started_program.hpp"

namespace touchdown::faults {

std::string small_run(const ScratchFolder& folder) {
  folder.write("fall.yaml", R"(name: fall
terrain: {pieces: [{flat: {length: 3.0}}]}
start: {clearance: 2.0}
end: {duration: 0.7}
simulation: {control_step_us: 5000}
perturbation: {yaw: 0.05}
)");
  folder.write("small.yaml", R"(name: small
seed: 3
simulators: [mujoco]
estimators: [measurement_only]
fit: {scenarios: [fall.yaml]}
test: {scenarios: [fall.yaml], runs: 1}
noise: {torque: [0.0], accelerometer: [0.0], seeds: 2}
highlights: [{torque: 0.0, accelerometer: 0.0}]
intervals: {resamples: 10}
video: {enabled: false, width: 320}
recordings: all
workers: 1
)");
  return "run small.yaml --out a";
}

std::string small_run_without_pictures(const ScratchFolder& folder) {
  return small_run(folder) + " --no-pictures";
}

std::string small_closed_loop(const ScratchFolder& folder) {
  std::string run = small_run_without_pictures(folder);
  std::ofstream(folder / "small.yaml", std::ios::app) << R"(closed_loop:
  contact: [truth, measurement_only, always]
  runs: 3
  scenes: [{scenario: fall.yaml}, {scenario: fall.yaml, delay: [0.0, 0.1]}]
)";
  return run;
}

std::string small_run_with_film(const ScratchFolder& folder) {
  return small_run(folder) + " --set video.enabled=true";
}

std::string small_film(const ScratchFolder& folder) {
  if (!std::filesystem::exists(folder / "fall.mpack")) {
    small_run(folder);
    (void)cli::StartedProgram("simulate fall.yaml -o fall.mpack", folder.path()).end();
  }
  return "render fall.mpack -o a/film.mp4 --to 0.2 --width 320 --height 180 --workers 2";
}

std::string small_training(const ScratchFolder& folder) {
  folder.write("train.yaml", R"(name: small
rollout:
  scenarios: [)" TOUCHDOWN_SOURCE_DIR R"(/scenarios/lift_drive.yaml]
  environments: 4
  steps: 20
network: {hidden: 8, first: 8, second: 4}
optimiser: {iterations: 2, epochs: 1, validation_episodes: 4}
)");
  return "train train.yaml --out a --threads 1";
}

bool all_of_them() { return std::getenv("TOUCHDOWN_ALL_FAULTS") != nullptr; }

}  // namespace touchdown::faults
