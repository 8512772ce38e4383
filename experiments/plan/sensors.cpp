#include "experiments/plan/sensors.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/fields.hpp"
#include "core/files.hpp"
#include "experiments/plan/condition.hpp"
#include "noise/reported_signals.hpp"

namespace touchdown::experiments {

namespace {

std::filesystem::path kept_file(const std::filesystem::path& run_directory, std::size_t number) {
  return run_directory / "state" / fmt::format("sensors_{:03}.yaml", number);
}

}  // namespace

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

std::vector<NamedSensors> read_sensors(const Experiment& experiment,
                                       const std::filesystem::path& run_directory) {
  std::vector<NamedSensors> sensors;
  for (const std::string& file : sensor_files(experiment)) {
    const auto kept = YamlDocument::load(kept_file(run_directory, sensors.size()));
    sensors.push_back({file, from_yaml<noise::SensorProfile>(kept)});
  }
  return sensors;
}

void write_sensors(const std::vector<NamedSensors>& sensors,
                   const std::filesystem::path& run_directory) {
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    write_atomically(kept_file(run_directory, i), noise::to_yaml(sensors[i].profile));
  }
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
                            std::int64_t run, recordings::Recording& recording) {
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

}  // namespace touchdown::experiments
