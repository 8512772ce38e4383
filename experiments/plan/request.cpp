#include "experiments/plan/request.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/fingerprint.hpp"
#include "core/resources.hpp"
#include "core/yaml.hpp"

namespace touchdown::experiments {

namespace {

namespace fs = std::filesystem;

std::string id_of(const RunRequest& request) {
  Fingerprint fingerprint;
  fingerprint.add(to_yaml(request.experiment));
  for (const NamedScenario& named : request.scenarios) {
    fingerprint.add(scenarios::to_yaml(named.scenario)).add(read_file(named.scenario.robot));
  }
  return fingerprint.text();
}

/// Every scenario file that the experiment names, once, as `read` finds the n-th of them.
template <typename Read>
std::vector<NamedScenario> scenarios_of(const Experiment& experiment, const Read& read) {
  std::vector<NamedScenario> scenarios;
  std::vector<std::string> files = experiment.fit.scenarios;
  files.insert(files.end(), experiment.test.scenarios.begin(), experiment.test.scenarios.end());
  for (const FitPieces& pieces : experiment.fit_pieces) files.push_back(pieces.scenario);
  for (const std::string& file : files) {
    const bool known = std::any_of(scenarios.begin(), scenarios.end(),
                                   [&](const NamedScenario& named) { return named.file == file; });
    if (known) continue;
    scenarios.push_back({file, read(file, scenarios.size())});
    scenarios::Scenario& scenario = scenarios.back().scenario;
    scenario.robot = find_resource(scenario.robot);
  }
  return scenarios;
}

std::string scenario_file(std::size_t number) { return fmt::format("scenario_{:03}.yaml", number); }

}  // namespace

RunRequest request_of(const Experiment& experiment) {
  RunRequest request{experiment, {}, {}};
  request.scenarios = scenarios_of(experiment, [](const std::string& file, std::size_t /*n*/) {
    return scenarios::find_scenario(file);
  });
  request.id = id_of(request);
  return request;
}

const NamedScenario& scenario_of(const RunRequest& request, const std::string& file) {
  return *std::find_if(request.scenarios.begin(), request.scenarios.end(),
                       [&](const NamedScenario& named) { return named.file == file; });
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
                     scenarios::to_yaml(request.scenarios[i].scenario));
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
  request.scenarios =
      scenarios_of(request.experiment, [&](const std::string& /*file*/, std::size_t number) {
        return scenarios::scenario_from_yaml(
            YamlDocument::load(directory / "state" / scenario_file(number)));
      });
  const std::string key = read_file(key_file);
  request.id = key.substr(0, key.find(" build ")).substr(std::string("experiment ").size());
  if (key != state_key(request) + "\n") {
    throw InputError(
        fmt::format("{}: was computed by another build of touchdown: run it again with this one",
                    directory.string()));
  }
  return request;
}

}  // namespace touchdown::experiments
