#include "apps/cli/file_kinds.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/training/config/training.hpp"
#include "core/error.hpp"
#include "core/fields.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "logs/mapping/mapping.hpp"
#include "noise/sensor_profile.hpp"
#include "scenarios/scenario_file.hpp"

namespace touchdown::cli {

const std::vector<FileKind>& file_kinds() {
  static const std::vector<FileKind> kinds = {
      {"experiment", "Experiment files",
       "They specify runs, estimators, noise, scores and studies: `touchdown run "
       "experiments/stairs.yaml`.",
       experiments::experiment_keys},
      {"scenario", "Scenario files",
       "They specify robot, terrain, policy, forces and the end of a run: `touchdown simulate "
       "scenarios/stairs.yaml -o run.mpack`.",
       scenarios::scenario_keys},
      {"robot", "Robot files",
       "They modify an MJCF and are named by the key `robot` of scenarios and experiments: "
       "`models/upkie_actuated.yaml`.",
       scenarios::robot_keys},
      {"sensors", "Sensor profiles",
       "They specify sensor errors and are named by the key `sensors` of experiments: "
       "`noise/profiles/upkie.yaml`.",
       [] { return documented_keys(noise::SensorProfile()); }},
      {"mapping", "Mapping files",
       "They map the columns of another robot's log to signals: `touchdown convert robot.csv "
       "--mapping robot.yaml -o robot.mpack`.",
       logs::mapping_keys},
      {"training", "Training files",
       "They specify data, size and training of the neural network: `touchdown train "
       "experiments/nmn.yaml`.",
       training::training_keys}};
  return kinds;
}

const FileKind& file_kind(const std::string& name) {
  std::vector<std::string> names;
  for (const FileKind& kind : file_kinds()) {
    if (kind.name == name) return kind;
    names.push_back(kind.name);
  }
  const std::string near = did_you_mean(name, names);
  throw InputError(
      fmt::format("unknown kind of file '{}'{}", name,
                  near.empty() ? fmt::format(" (known: {})", fmt::join(names, ", ")) : near));
}

}  // namespace touchdown::cli
