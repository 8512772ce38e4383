#include <thread>
#include <vector>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "experiments/config/experiment_yaml.hpp"
#include "experiments/config/yaml_kind.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/evaluation/tasks.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/plan/condition.hpp"
#include "noise/sensor_noise.hpp"
#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

constexpr std::size_t run_steps = 13'000;

/// The default study's grids: 13 × 13 torque × accelerometer, 9 × 9 knee × wheel.
Experiment study(const std::vector<std::string>& estimators) {
  const YamlDocument document =
      completed(YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/experiments/noise_study.yaml"),
                YamlKind::experiment);
  Experiment experiment = experiment_from_yaml(document);
  experiment.simulators = {"mujoco"};
  experiment.estimators = estimators;
  return experiment;
}

double cell_updates(const Experiment& experiment, const std::vector<noise::NoiseCell>& cells) {
  return static_cast<double>(experiment.estimators.size() * cells.size() * run_steps);
}

/// One estimator evaluated on one run with one noise realisation, in every cell, on one core. The
/// rate counts one step in one cell as one update.
void one_task(benchmark::State& state, const std::string& estimator,
              const decltype(&sweep_run)& sweep) {
  const Experiment experiment = study({estimator});
  const FittedModels models = fit_models(experiment, pointers_to({synthetic_run(first_fit_run)}));
  const RunSignals run = synthetic_run(0, run_steps);
  const NoiseRun noise = noise_run(run, noise_key(experiment, 0, 0));
  const std::vector<noise::NoiseCell> cells = noise::noise_cells(experiment.noise);
  const std::vector<Condition> conditions = {{"mujoco", "mujoco", estimator}};
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        sweep(conditions, cells, run, noise, models, experiment, [] { return true; }));
  }
  state.counters["cell_updates"] = benchmark::Counter(
      cell_updates(experiment, cells), benchmark::Counter::kIsIterationInvariantRate);
}

/// All estimators, several runs and seeds, on `state.range(0)` threads; wall-clock time. The rate
/// divided by the number of threads shows the parallel efficiency.
void on_threads(benchmark::State& state) {
  const auto threads = static_cast<std::size_t>(state.range(0));
  if (threads > std::thread::hardware_concurrency()) {
    state.SkipWithError("fewer cores than threads");
    return;
  }
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  Experiment experiment = study(estimator_names());
  std::erase(experiment.estimators, always_contact_name);
  experiment.noise.seeds = 4;
  const FittedModels models = fit_models(experiment, pointers_to({synthetic_run(first_fit_run)}));
  const std::vector<RunSignals> runs = {synthetic_run(0, run_steps), synthetic_run(1, run_steps)};
  const std::vector<noise::NoiseCell> cells = noise::noise_cells(experiment.noise);
  const std::vector<Condition> conditions = own_engine_conditions(experiment);
  const std::size_t tasks = runs.size() * static_cast<std::size_t>(experiment.noise.seeds);
  for (auto _ : state) {
    tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
      const RunSignals& run = runs[task % runs.size()];
      const auto seed = static_cast<int>(task / runs.size());
      const NoiseRun noise = noise_run(run, noise_key(experiment, seed, run.info.run));
      benchmark::DoNotOptimize(
          sweep_run(conditions, cells, run, noise, models, experiment, [] { return true; }));
    });
  }
  state.counters["cell_updates"] = benchmark::Counter(
      8.0 * cell_updates(experiment, cells), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(on_threads)->Arg(1)->Arg(2)->Arg(4)->UseRealTime()->Unit(benchmark::kMillisecond);

/// Every estimator batched over noise levels, and some one level at a time.
const bool registered = [] {
  for (const std::string& name : estimator_names()) {
    benchmark::RegisterBenchmark(("batch/" + name).c_str(), one_task, name, &sweep_run)
        ->Unit(benchmark::kMillisecond);
  }
  for (const char* name : {"robust", "measurement_only", "nmn"}) {
    benchmark::RegisterBenchmark((std::string("one_by_one/") + name).c_str(), one_task,
                                 std::string(name), &sweep_run_one_by_one)
        ->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
}  // namespace touchdown::experiments
