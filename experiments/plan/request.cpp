#include "experiments/plan/request.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>
#include <string_view>
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
#include "experiments/estimators/registry.hpp"
#include "experiments/plan/condition.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "models/robot_description.hpp"
#include "noise/reported_signals.hpp"
#include "scenarios/generation/generate.hpp"

namespace touchdown::experiments {

namespace {

std::filesystem::path kept_file(const std::filesystem::path& run_directory, std::size_t number) {
  return run_directory / "state" / fmt::format("sensors_{:03}.yaml", number);
}

namespace fs = std::filesystem;

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
  const ExperimentFiles files = files_of(experiment);
  for (const std::string& robot : files.robots) {
    for (const std::string& file : files.scenarios) {
      if (find_named(scenarios, file, robot) != scenarios.end()) continue;
      scenarios.push_back({file, robot, read(file, robot, scenarios.size())});
      scenarios::Scenario& scenario = scenarios.back().scenario;
      scenario.robot = find_resource(scenario.robot);
    }
  }
  return scenarios;
}

std::string scenario_file(std::size_t number) { return fmt::format("scenario_{:03}.yaml", number); }

fs::path inputs_file(const fs::path& run_directory) {
  return run_directory / "state" / "inputs.yaml";
}

/// Lists the inputs of a request with scenarios and sensors. What is resolved from other files
/// comes after them, so that the first difference between two lists is its cause.
std::vector<RequestInput> inputs_of(const RunRequest& request) {
  std::vector<RequestInput> inputs;
  std::map<fs::path, std::string> listed;  // with their digests
  const auto add_text = [&](const std::string& file, std::string_view text) {
    inputs.push_back({file, Fingerprint().add(text).text()});
  };
  const auto add_file = [&](const fs::path& file) -> const std::string& {
    const auto [one, is_new] = listed.try_emplace(fs::canonical(file));
    if (is_new) inputs.push_back({file.string(), one->second = file_fingerprint(file)});
    return one->second;
  };
  std::map<std::string, std::string> robots;  // digests of all their files, by path
  for (const NamedScenario& named : request.scenarios) {
    const auto [robot, is_new] = robots.try_emplace(named.scenario.robot);
    if (!is_new) continue;
    Fingerprint all;
    for (const fs::path& file : models::robot_files(robot->first)) all.add(add_file(file));
    robot->second = all.text();
  }
  for (const std::string& name : request.experiment.estimators) {
    const EstimatorEntry& entry = estimator_entry(request.experiment, name);
    if (!entry.revision.empty()) add_text(name, entry.revision);
    const std::string& model = entry.making.model_file;
    if (model.empty()) continue;
    try {
      add_file(find_program_file(model));
    } catch (const InputError&) {
      // The estimator complains, with advice on how to make its model.
    }
  }
  for (const NamedSensors& named : request.sensors) {
    add_text(named.file, noise::to_yaml(named.profile));
  }
  for (const NamedScenario& named : request.scenarios) {
    scenarios::Scenario scenario = named.scenario;
    scenario.robot = robots.at(scenario.robot);  // the path depends on the working directory
    add_text(named.file, scenarios::to_yaml(scenario));
  }
  add_text("config.yaml", to_yaml(request.experiment));
  return inputs;
}

/// Names do not count: paths depend on the working directory.
std::string id_of(const std::vector<RequestInput>& inputs) {
  Fingerprint all;
  for (const RequestInput& input : inputs) all.add(input.digest);
  return all.text();
}

std::string to_yaml(const std::vector<RequestInput>& inputs) {
  YAML::Node document;
  for (const RequestInput& input : inputs) {
    YAML::Node node;
    node["file"] = input.file;
    node["digest"] = input.digest;
    document["inputs"].push_back(node);
  }
  return YAML::Dump(document) + "\n";
}

std::vector<RequestInput> written_inputs(const fs::path& directory) {
  std::vector<RequestInput> inputs;
  if (!is_there(inputs_file(directory))) return inputs;
  const auto list = YamlDocument::load(inputs_file(directory));
  for (const YAML::Node& node : list.root()["inputs"]) {
    inputs.push_back({node["file"].as<std::string>(""), node["digest"].as<std::string>("")});
  }
  return inputs;
}

/// The first of these inputs that is not among the others.
const RequestInput* first_missing(const std::vector<RequestInput>& inputs,
                                  const std::vector<RequestInput>& others) {
  const auto found = std::find_if(inputs.begin(), inputs.end(), [&](const RequestInput& input) {
    return std::none_of(others.begin(), others.end(),
                        [&](const RequestInput& other) { return other.digest == input.digest; });
  });
  return found == inputs.end() ? nullptr : &*found;
}

/// The first line that differs, behind its section: " (noise: seeds: 2)"; empty without any.
std::string first_difference(const std::string& now, const std::string& then) {
  std::istringstream lines(now), others(then);
  std::string section, line, other;
  while (std::getline(lines, line) && std::getline(others, other)) {
    const std::size_t indent = line.find_first_not_of(' ');
    if (indent == 0) section.clear();
    if (line != other && indent <= line.size()) {
      return fmt::format(" ({}{})", section, line.substr(indent));
    }
    if (indent == 0) section = line + ' ';
  }
  return {};
}

/// Names the first input in which a request differs from the one of a run directory.
std::string difference_text(const fs::path& directory, const RunRequest& request) {
  const std::vector<RequestInput>& now = request.inputs;
  const std::vector<RequestInput> then = written_inputs(directory);
  if (then.empty()) return "its state/inputs.yaml is missing: an older program wrote it";
  const RequestInput* const input = first_missing(now, then);
  if (input == nullptr) {
    const RequestInput* const left_out = first_missing(then, now);
    return left_out == nullptr ? "its inputs have another order"
                               : fmt::format("{} was read then, and is not now", left_out->file);
  }
  const bool was_read = std::any_of(then.begin(), then.end(), [&](const RequestInput& other) {
    return fs::path(other.file).filename() == fs::path(input->file).filename();
  });
  const fs::path there = directory / input->file;
  const bool is_experiment = input->file == "config.yaml" && is_there(there);
  const std::string difference =
      is_experiment ? first_difference(to_yaml(request.experiment), read_file(there)) : "";
  if (!difference.empty()) return "its config.yaml is of another request" + difference;
  return fmt::format("{} was {} since", input->file, was_read ? "changed" : "added");
}

/// Identifies the results of a directory: the request, and the build that computes it.
std::string state_key(const RunRequest& request) { return key_of(request.id, build_fingerprint()); }

/// Reads the sensor profiles of an experiment. Clears the experiment's own `sensors` if that
/// profile is ideal, so that ideal sensors and none are the same request. Errors: `InputError` for
/// a file that is missing or wrong.
std::vector<NamedSensors> read_sensors(Experiment& experiment) {
  std::vector<NamedSensors> sensors;
  for (const std::string& file : files_of(experiment).sensors) {
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
  for (const std::string& file : files_of(experiment).sensors) {
    const auto kept = YamlDocument::load(kept_file(run_directory, sensors.size()));
    sensors.push_back({file, from_yaml<noise::SensorProfile>(kept)});
  }
  return sensors;
}

noise::SensorProfile profile_of(const std::vector<NamedSensors>& sensors, const std::string& file) {
  const auto named = std::ranges::find(sensors, file, &NamedSensors::file);
  return named == sensors.end() ? noise::SensorProfile{} : named->profile;
}

noise::NoiseKey sensor_key(const Experiment& experiment, std::int64_t run) {
  constexpr std::uint64_t sensor_stream = 0x73656e736f7273;  // "sensors"
  return draws_of(experiment.seed, sensor_stream, 0, run);
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
  RunRequest request;
  request.experiment = experiment;
  request.scenarios = scenarios_of(
      experiment, [&](const std::string& file, const std::string& robot, std::size_t /*n*/) {
        return scenarios::find_scenario(file, robot.empty() ? experiment.robot : robot);
      });
  request.sensors = read_sensors(request.experiment);
  request.inputs = inputs_of(request);
  request.id = id_of(request.inputs);
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
  const std::string difference =
      owner->name == request.experiment.name ? "; " + difference_text(directory, request) : "";
  throw InputError(fmt::format(
      "{}: holds experiment '{}' (request {}), and this is '{}' (request {}){}: choose another "
      "--out or replace it with --overwrite",
      directory.string(), owner->name, owner->request, request.experiment.name, request.id,
      difference));
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
    write_atomically(directory.own_file("state", scenario_file(i)),
                     scenarios::to_yaml(request.scenarios[i].scenario));
  }
  for (std::size_t i = 0; i < request.sensors.size(); ++i) {
    write_atomically(record_file(directory.path(), kept_file({}, i)),
                     noise::to_yaml(request.sensors[i].profile));
  }
  write_atomically(directory.own_file("state", "inputs.yaml"), to_yaml(request.inputs));
  write_atomically(directory.own_file("", "config.yaml"), to_yaml(request.experiment));
}

RunRequest read_request(const fs::path& directory) {
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
  request.experiment = experiment_from_yaml(YamlDocument::load(directory / "config.yaml"),
                                            written_estimators(directory));
  if (const fs::path manifest = directory / "manifest.json"; is_there(manifest)) {
    // Of a finished run. It changes no result, so that config.yaml lacks it.
    std::string& heatmap = request.experiment.figures.heatmap;
    heatmap = YamlDocument::load(manifest).root()["heatmap"].as<std::string>(heatmap);
  }
  request.sensors = read_sensors(request.experiment, directory);
  request.scenarios = scenarios_of(
      request.experiment,
      [&](const std::string& /*file*/, const std::string& /*robot*/, std::size_t number) {
        return scenarios::scenario_from_yaml(
            YamlDocument::load(directory / "state" / scenario_file(number)));
      });
  request.inputs = inputs_of(request);
  request.id = id_of(request.inputs);
  if (request.id != owner->request) {
    throw InputError(fmt::format(
        "{}: {}: its inputs make request {}, expected {}; undo the change, or run the changed "
        "experiment elsewhere",
        directory.string(), difference_text(directory, request), request.id, owner->request));
  }
  return request;
}

}  // namespace touchdown::experiments
