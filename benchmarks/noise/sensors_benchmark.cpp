// What a run's sensors cost beside its simulation: the chain of each shipped profile on a run down
// the stairs, and what it took to play that run in MuJoCo.

#include <algorithm>
#include <chrono>

#include <benchmark/benchmark.h>

#include "noise/sensors/reported.hpp"
#include "scenarios/engine.hpp"

namespace touchdown::noise {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Played and reported in turn, so that whatever else the machine does meets both; the fastest of
/// each counts.
void sensors(benchmark::State& state, const char* file) {
  scenarios::Scenario scenario =
      scenarios::load_scenario(TOUCHDOWN_SOURCE_DIR "/scenarios/stairs.yaml");
  scenario.robot = TOUCHDOWN_SOURCE_DIR "/models/upkie.xml";
  const auto simulator = scenarios::make_simulator(scenario, "mujoco");
  const SensorProfile profile = find_sensor_profile(file);
  double played = 1e9;
  double reported = 1e9;
  double steps = 1.0;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    recordings::Recording recording = scenarios::play(scenario, *simulator);
    played = std::min(played, seconds_since(start));
    steps = static_cast<double>(recording.steps());
    for (int again = 0; again < 5; ++again) {
      std::vector<models::Observation> observations = recording.observation;
      const auto before = std::chrono::steady_clock::now();
      report_through(profile, {1, 2}, recording.period(), observations);
      reported = std::min(reported, seconds_since(before));
      benchmark::DoNotOptimize(observations.data());
    }
  }
  state.counters["played_us"] = 1e6 * played / steps;
  state.counters["reported_us"] = 1e6 * reported / steps;
  state.counters["percent"] = 100.0 * reported / played;
}
BENCHMARK_CAPTURE(sensors, ideal, "sensors/ideal.yaml")->Iterations(10);
BENCHMARK_CAPTURE(sensors, upkie, "sensors/upkie.yaml")->Iterations(10);
BENCHMARK_CAPTURE(sensors, harsh, "sensors/harsh.yaml")->Iterations(10);

}  // namespace
}  // namespace touchdown::noise
