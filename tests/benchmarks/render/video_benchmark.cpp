#include <filesystem>
#include <limits>
#include <sys/resource.h>

#include <benchmark/benchmark.h>

#include "render/film/video.hpp"
#include "tests/render/staged_run.hpp"

// End to end: painting in forked workers, encoding in this process, into one file. 1280x720 at 30
// fps.

namespace touchdown::render {
namespace {

constexpr double seconds = 8.0;

void report(benchmark::State& state, const VideoStatistics& statistics) {
  rusage children = {};
  ::getrusage(RUSAGE_CHILDREN, &children);
  state.counters["fps"] = statistics.fps();
  state.counters["worker_MB"] = static_cast<double>(children.ru_maxrss) / 1024.0;
}

VideoOptions options(benchmark::State& state) {
  VideoOptions options;
  options.quality = state.range(0) == 0 ? VideoQuality::draft : VideoQuality::page;
  options.workers = static_cast<int>(state.range(1));
  return options;
}

void film(benchmark::State& state) {
  const models::RobotModel robot = models::compile_robot_model(upkie_mjcf, staged_terrain());
  const logs::Recording run = staged_run(seconds);
  const std::vector<BeliefTrack> beliefs = {staged_beliefs(run, "robust")};
  const auto path = std::filesystem::temp_directory_path() / "touchdown-bench.mp4";
  VideoStatistics statistics;
  for (auto _ : state) statistics = render_video({{robot, run, beliefs}}, options(state), path);
  std::filesystem::remove(path);
  report(state, statistics);
}

void film_side_by_side(benchmark::State& state) {
  const models::RobotModel robot = models::compile_robot_model(upkie_mjcf, staged_terrain());
  const logs::Recording left = staged_run(seconds, "mujoco");
  const logs::Recording right = staged_run(seconds, "bullet");
  const std::vector<BeliefTrack> beliefs = {staged_beliefs(left, "robust")};
  const auto path = std::filesystem::temp_directory_path() / "touchdown-bench.mp4";
  VideoStatistics statistics;
  for (auto _ : state) {
    statistics =
        render_video({{robot, left, beliefs}, {robot, right, beliefs}}, options(state), path);
  }
  std::filesystem::remove(path);
  report(state, statistics);
}

BENCHMARK(film)
    ->ArgNames({"page", "workers"})
    ->ArgsProduct({{0, 1}, {1, 2, 4}})
    ->Unit(benchmark::kSecond)
    ->Iterations(1)
    ->UseRealTime();
BENCHMARK(film_side_by_side)
    ->ArgNames({"page", "workers"})
    ->ArgsProduct({{0, 1}, {4}})
    ->Unit(benchmark::kSecond)
    ->Iterations(1)
    ->UseRealTime();

}  // namespace
}  // namespace touchdown::render
