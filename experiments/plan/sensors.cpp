#include "experiments/plan/sensors.hpp"

#include "core/fields.hpp"
#include "core/files.hpp"
#include "core/random.hpp"
#include "noise/sensors/reported.hpp"

namespace touchdown::experiments {

namespace {

std::filesystem::path kept_file(const std::filesystem::path& run_directory) {
  return run_directory / "state" / "sensors.yaml";
}

/// Of the one realisation that a run of the experiment has, whatever noise is added to it.
noise::NoiseKey sensor_key(const Experiment& experiment, std::int64_t run) {
  constexpr std::uint64_t sensor_stream = 0x73656e736f7273;  // "sensors"
  const auto bits = philox(experiment.seed, sensor_stream, 0);
  return {.seed = (std::uint64_t{bits[0]} << 32U) | bits[1],
          .run = static_cast<std::uint64_t>(run)};
}

}  // namespace

void read_sensors(Experiment& experiment) {
  if (experiment.sensors.empty()) return;
  experiment.sensor_profile = noise::find_sensor_profile(experiment.sensors);
  if (!noise::is_ideal(experiment.sensor_profile)) return;
  experiment.sensors.clear();
  experiment.sensor_profile = {};
}

void read_sensors(Experiment& experiment, const std::filesystem::path& run_directory) {
  if (experiment.sensors.empty()) return;
  experiment.sensor_profile =
      from_yaml<noise::SensorProfile>(YamlDocument::load(kept_file(run_directory)));
}

void write_sensors(const Experiment& experiment, const std::filesystem::path& run_directory) {
  if (experiment.sensors.empty()) return;
  write_atomically(kept_file(run_directory), noise::to_yaml(experiment.sensor_profile));
}

void report_through_sensors(const Experiment& experiment, std::int64_t run, double period,
                            std::vector<models::Observation>& observations) {
  noise::report_through(experiment.sensor_profile, sensor_key(experiment, run), period,
                        observations);
}

std::string sensors_text(const Experiment& experiment) {
  return experiment.sensors.empty() ? "" : "; sensors as in " + experiment.sensors;
}

}  // namespace touchdown::experiments
