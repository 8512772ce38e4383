// Time of the sensor chain of each shipped profile on a run down the stairs, compared with
// simulating that run in MuJoCo.

#include <algorithm>
#include <chrono>

#include <benchmark/benchmark.h>

#include "noise/reported_signals.hpp"
#include "scenarios/engine.hpp"

namespace touchdown::noise {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Simulates and applies sensors in turn under the same load; the fastest of each counts.
void sensors(benchmark::State& state, const char* file) {
  scenarios::Scenario scenario = scenarios::scenario_from_yaml(
      YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/scenarios/stairs.yaml"));
  scenario.robot = TOUCHDOWN_SOURCE_DIR "/models/upkie.xml";
  const auto simulator = scenarios::make_simulator(scenario, "mujoco");
  const SensorProfile profile = find_sensor_profile(file);
  double simulation = 1e9;
  double sensor_chain = 1e9;
  double steps = 1.0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    logs::Recording recording = scenarios::play(scenario, *simulator);
    simulation = std::min(simulation, seconds_since(start));
    steps = static_cast<double>(recording.steps());
    for (int again = 0; again < 5; ++again) {
      std::vector<models::Observation> observations = recording.observation;
      const auto before = std::chrono::steady_clock::now();
      report_through(profile, {1, 2}, recording.period(), observations);
      sensor_chain = std::min(sensor_chain, seconds_since(before));
      benchmark::DoNotOptimize(observations.data());
    }
  }
  state.counters["simulation_us"] = 1e6 * simulation / steps;
  state.counters["sensors_us"] = 1e6 * sensor_chain / steps;
  state.counters["percent"] = 100.0 * sensor_chain / simulation;
}
BENCHMARK_CAPTURE(sensors, ideal, "noise/profiles/ideal.yaml")->Iterations(10);
BENCHMARK_CAPTURE(sensors, upkie, "noise/profiles/upkie.yaml")->Iterations(10);
BENCHMARK_CAPTURE(sensors, harsh, "noise/profiles/harsh.yaml")->Iterations(10);

}  // namespace
}  // namespace touchdown::noise
