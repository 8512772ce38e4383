#include "experiments/run_request.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/yaml.hpp"
#include "experiments/fingerprint.hpp"
#include "experiments/manifest.hpp"
#include "experiments/resources.hpp"

namespace touchdown {

namespace {

namespace fs = std::filesystem;

std::string id_of(const Experiment& experiment, const std::vector<NamedScenario>& scenarios) {
  Fingerprint fingerprint;
  fingerprint.add(to_yaml(experiment));
  for (const NamedScenario& named : scenarios) {
    fingerprint.add(to_yaml(named.scenario)).add(read_file(named.scenario.robot));
  }
  return fingerprint.text();
}

std::string scenario_file(std::size_t number) { return fmt::format("scenario_{:03}.yaml", number); }

}  // namespace

RunRequest request_of(const Experiment& experiment) {
  RunRequest request{experiment, load_scenarios(experiment), {}};
  request.id = id_of(request.experiment, request.scenarios);
  return request;
}

std::string state_key(const RunRequest& request) {
  return fmt::format("experiment {} build {}", request.id, build_fingerprint());
}

void write_request(const RunRequest& request, const RunDirectory& directory, bool alone) {
  const fs::path key_file = directory.file("state", "key");
  const std::string key = state_key(request) + "\n";
  std::error_code ignored;
  if (alone && fs::exists(key_file, ignored) && read_file(key_file) != key) {
    for (const char* folder : {"state", "recordings", "models", "tables", "figures", "videos"}) {
      fs::remove_all(directory.path() / folder);
    }
  }
  for (std::size_t i = 0; i < request.scenarios.size(); ++i) {
    write_atomically(directory.file("state", scenario_file(i)),
                     to_yaml(request.scenarios[i].scenario));
  }
  write_atomically(directory.path() / "config.yaml", to_yaml(request.experiment));
  write_atomically(key_file, key);
}

RunRequest read_request(const fs::path& directory) {
  const fs::path key_file = directory / "state" / "key";
  std::error_code ignored;
  if (!fs::exists(key_file, ignored)) {
    throw InputError(fmt::format("{}: holds no part of an experiment", directory.string()));
  }
  RunRequest request;
  request.experiment = experiment_from_yaml(YamlDocument::load(directory / "config.yaml"));
  for (const RunsConfig* runs : {&request.experiment.fit, &request.experiment.test}) {
    for (const std::string& file : runs->scenarios) {
      const bool known =
          std::any_of(request.scenarios.begin(), request.scenarios.end(),
                      [&](const NamedScenario& named) { return named.file == file; });
      if (known) continue;
      const fs::path scenario = directory / "state" / scenario_file(request.scenarios.size());
      request.scenarios.push_back({file, scenario_from_yaml(YamlDocument::load(scenario))});
      Scenario& read = request.scenarios.back().scenario;
      read.robot = find_resource(read.robot);
    }
  }
  const std::string key = read_file(key_file);
  request.id = key.substr(0, key.find(" build ")).substr(std::string("experiment ").size());
  if (key != state_key(request) + "\n") {
    throw InputError(
        fmt::format("{}: was computed by another build of touchdown: run it again with this one",
                    directory.string()));
  }
  return request;
}

}  // namespace touchdown
