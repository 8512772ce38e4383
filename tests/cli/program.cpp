#include "program.hpp"

#include <cstdlib>
#include <sys/wait.h>

#include "core/files.hpp"

namespace touchdown::cli {

Ended touchdown_program(const std::string& arguments, const std::filesystem::path& folder) {
  const std::filesystem::path out = folder / ".stdout";
  const std::filesystem::path err = folder / ".stderr";
  const std::string command = "cd '" + folder.string() + "' && '" TOUCHDOWN_PROGRAM "' " +
                              arguments + " >'" + out.string() + "' 2>'" + err.string() + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out), read_file(err)};
}

std::string write_tiny_experiment(const ScratchFolder& folder) {
  folder.write("step.yaml", R"(name: step
terrain:
  pieces:
    - flat: {length: 3.0}
    - stairs: {count: 1, run: 3.0, rise: 0.25, nosing_radius: 0.025}
start: {x: 0.7}
velocity: [{time: 0.3, velocity: 0.5}]
end: {duration: 2.5}
perturbation: {velocity: 0.1, yaw: 0.05}
)");
  folder.write("tiny.yaml", R"(name: tiny
seed: 3
simulators: [mujoco, bullet]
estimators: [robust, measurement_only, upkie_observer]
fit: {scenarios: [step.yaml]}
test: {scenarios: [step.yaml], runs: 3}
noise: {torque: [0.0, 1.0], accelerometer: [0.0, 5.0], seeds: 2}
highlights: [{torque: 1.0, accelerometer: 5.0}]
intervals: {resamples: 100}
video: {enabled: false}
recordings: all
)");
  return "tiny.yaml";
}

std::string write_long_experiment(const ScratchFolder& folder) {
  folder.write("long.yaml", R"(name: long
terrain: {pieces: [{flat: {length: 9.0}}]}
start: {x: 0.7}
end: {duration: 600.0}
)");
  folder.write("x.yaml",
               "name: x\nfit: {scenarios: [long.yaml]}\ntest: {scenarios: [long.yaml]}\n");
  return "x.yaml";
}

}  // namespace touchdown::cli
