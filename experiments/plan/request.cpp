#include "experiments/plan/request.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/fields.hpp"
#include "core/files.hpp"
#include "core/fingerprint.hpp"
#include "core/resources.hpp"
#include "core/yaml.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/plan/condition.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "noise/reported_signals.hpp"
#include "scenarios/generation/generate.hpp"

namespace touchdown::experiments {

namespace {

std::filesystem::path kept_file(const std::filesystem::path& run_directory, std::size_t number) {
  return run_directory / "state" / fmt::format("sensors_{:03}.yaml", number);
}

namespace fs = std::filesystem;

/// The digest of a request. Scenarios are added one by one.
class Digest {
 public:
  Digest(const Experiment& experiment, const std::vector<NamedSensors>& sensors) {
    fingerprint_.add(to_yaml(experiment));
    for (const NamedSensors& named : sensors) fingerprint_.add(noise::to_yaml(named.profile));
    for (const std::string& name : experiment.estimators) {
      const std::string& revision = estimator_entry(experiment, name).revision;
      if (!revision.empty()) fingerprint_.add(revision);
    }
  }
  /// Includes the robot's path as the scenario gives it, and the content of its file.
  void add(const scenarios::Scenario& scenario) {
    fingerprint_.add(scenarios::to_yaml(scenario)).add(scenarios::robot_text(scenario));
  }
  std::string text() const { return fingerprint_.text(); }

 private:
  Fingerprint fingerprint_;
};

std::vector<NamedScenario>::const_iterator find_named(const std::vector<NamedScenario>& scenarios,
                                                      const std::string& file,
                                                      std::string_view robot) {
  return std::find_if(scenarios.begin(), scenarios.end(), [&](const NamedScenario& named) {
    return named.file == file && named.robot == robot;
  });
}

/// Every scenario file of the experiment, once with each of its robots. `read` loads the n-th one.
template <typename Read>
std::vector<NamedScenario> scenarios_of(const Experiment& experiment, const Read& read) {
  std::vector<NamedScenario> scenarios;
  for (const std::string& robot : robot_files(experiment)) {
    for (const std::string& file : scenario_files(experiment)) {
      if (find_named(scenarios, file, robot) != scenarios.end()) continue;
      scenarios.push_back({file, robot, read(file, robot, scenarios.size())});
      scenarios::Scenario& scenario = scenarios.back().scenario;
      scenario.robot = find_resource(scenario.robot);
    }
  }
  return scenarios;
}

std::string scenario_file(std::size_t number) { return fmt::format("scenario_{:03}.yaml", number); }

/// Identifies the results of a directory: the request, and the build that computes it.
std::string state_key(const RunRequest& request) { return key_of(request.id, build_fingerprint()); }

/// Reads the sensor profiles of an experiment. Clears the experiment's own `sensors` if that
/// profile is ideal, so that ideal sensors and none are the same request. Errors: `InputError` for
/// a file that is missing or wrong.
std::vector<NamedSensors> read_sensors(Experiment& experiment) {
  std::vector<NamedSensors> sensors;
  for (const std::string& file : sensor_files(experiment)) {
    sensors.push_back({file, noise::find_sensor_profile(file)});
  }
  if (!experiment.sensors.empty() && noise::is_ideal(sensors.front().profile)) {
    experiment.sensors.clear();
    sensors.erase(sensors.begin());
  }
  return sensors;
}

}  // namespace

std::vector<NamedSensors> read_sensors(const Experiment& experiment,
                                       const std::filesystem::path& run_directory) {
  std::vector<NamedSensors> sensors;
  for (const std::string& file : sensor_files(experiment)) {
    const auto kept = YamlDocument::load(kept_file(run_directory, sensors.size()));
    sensors.push_back({file, from_yaml<noise::SensorProfile>(kept)});
  }
  return sensors;
}

noise::SensorProfile profile_of(const std::vector<NamedSensors>& sensors, const std::string& file) {
  const auto named = std::find_if(sensors.begin(), sensors.end(),
                                  [&](const NamedSensors& one) { return one.file == file; });
  return named == sensors.end() ? noise::SensorProfile{} : named->profile;
}

noise::NoiseKey sensor_key(const Experiment& experiment, std::int64_t run) {
  constexpr std::uint64_t sensor_stream = 0x73656e736f7273;  // "sensors"
  return draws_of(experiment, sensor_stream, 0, run);
}

void report_through_sensors(const noise::SensorProfile& profile, const Experiment& experiment,
                            std::int64_t run, logs::Recording& recording) {
  const noise::NoiseKey key = sensor_key(experiment, run);
  noise::report_through(profile, key, recording.period(), recording.observation);
  noise::report_targets(profile, key, recording.action);
}

std::string setup_caption(const Experiment& experiment) {
  std::string text;
  if (!experiment.robot.empty()) text += "; robot as in " + experiment.robot;
  if (!experiment.sensors.empty()) text += "; sensors as in " + experiment.sensors;
  return text;
}

RunRequest request_of(const Experiment& experiment) {
  RunRequest request{experiment, {}, {}, {}};
  request.scenarios = scenarios_of(
      experiment, [&](const std::string& file, const std::string& robot, std::size_t /*n*/) {
        return scenarios::find_scenario(file, robot.empty() ? experiment.robot : robot);
      });
  request.sensors = read_sensors(request.experiment);
  Digest digest(request.experiment, request.sensors);
  for (const NamedScenario& named : request.scenarios) digest.add(named.scenario);
  request.id = digest.text();
  return request;
}

const NamedScenario& scenario_of(const RunRequest& request, const std::string& file,
                                 std::string_view robot) {
  return *find_named(request.scenarios, file, robot);
}

void require_place(const RunRequest& request, const fs::path& directory, bool overwrite) {
  require_no_links(directory);
  std::optional<RunDirectoryOwner> owner = owner_of(directory);
  if (!owner) {
    require_no_untracked_files(directory);
    owner = owner_of(directory);  // another process may own it now
  }
  if (!owner || owner->request == request.id || overwrite) return;
  throw InputError(fmt::format(
      "{}: holds experiment '{}' (request {}), and this is '{}' (request {}): choose another --out "
      "or replace it with --overwrite",
      directory.string(), owner->name, owner->request, request.experiment.name, request.id));
}

bool is_written(const RunRequest& request, const fs::path& directory) {
  const std::optional<RunDirectoryOwner> owner = owner_of(directory);
  std::error_code ignored;
  return owner && owner->key == state_key(request) &&
         fs::exists(directory / "config.yaml", ignored);
}

void write_request(const RunRequest& request, const RunDirectory& directory, bool overwrite) {
  require_place(request, directory.path(), overwrite);
  const std::optional<RunDirectoryOwner> owner = owner_of(directory.path());
  if (owner && owner->key != state_key(request)) remove_own_files(directory.path());
  // The key comes first: files of an interrupted write then do not count as untracked files.
  write_atomically(key_file(directory.path()), state_key(request) + "\n");
  for (std::size_t i = 0; i < request.scenarios.size(); ++i) {
    write_atomically(directory.file("state", scenario_file(i)),
                     scenarios::to_yaml(request.scenarios[i].scenario));
  }
  for (std::size_t i = 0; i < request.sensors.size(); ++i) {
    write_atomically(kept_file(directory.path(), i), noise::to_yaml(request.sensors[i].profile));
  }
  write_atomically(directory.path() / "config.yaml", to_yaml(request.experiment));
}

RunRequest read_request(const fs::path& directory, std::vector<StudySection> sections) {
  const std::optional<RunDirectoryOwner> owner = owner_of(directory);
  if (!owner || owner->key.empty()) {
    throw InputError(fmt::format("{}: holds no part of an experiment", directory.string()));
  }
  if (owner->key != key_of(owner->request, build_fingerprint())) {
    throw InputError(
        fmt::format("{}: was computed by another build of touchdown: run it again with this one",
                    directory.string()));
  }
  RunRequest request;
  request.experiment =
      experiment_from_yaml(YamlDocument::load(directory / "config.yaml"), std::move(sections), {});
  request.sensors = read_sensors(request.experiment, directory);
  Digest digest(request.experiment, request.sensors);
  request.scenarios = scenarios_of(
      request.experiment,
      [&](const std::string& /*file*/, const std::string& /*robot*/, std::size_t number) {
        scenarios::Scenario scenario = scenarios::scenario_from_yaml(
            YamlDocument::load(directory / "state" / scenario_file(number)));
        digest.add(scenario);
        return scenario;
      });
  request.id = digest.text();
  if (request.id != owner->request) {
    throw InputError(fmt::format(
        "{}: config.yaml, a scenario{} in state or the robot was changed since: they make request "
        "{}, expected {}; undo the change, or run the changed experiment elsewhere",
        directory.string(), request.sensors.empty() ? "" : ", the sensors", request.id,
        owner->request));
  }
  return request;
}

}  // namespace touchdown::experiments
