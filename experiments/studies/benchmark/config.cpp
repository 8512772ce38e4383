#include "experiments/studies/benchmark/config.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/files.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/config/experiment_yaml.hpp"

namespace touchdown::experiments {

static void describe(Fields& fields, BenchmarkConfig& benchmark, const Experiment& experiment) {
  const auto describe_files = [&](const char* key, std::vector<std::string>& files) {
    const KeyNotes notes = fields(key, files);
    for (auto file = files.begin(); file != files.end(); ++file) {
      fields.check(std::find(files.begin(), file, *file) == file, key,
                   fmt::format("'{}' appears twice", *file));
    }
    return notes;
  };
  describe_files("robots", benchmark.robots).doc("Files of further robots.");
  for (std::size_t i = 0; i < benchmark.robots.size(); ++i) {
    // Recordings are named after the robot's file.
    const std::string name = std::filesystem::path(benchmark.robots[i]).stem().string();
    fields.check_item(
        is_name_word(name), "robots", i,
        fmt::format("the file's name without extension, '{}': {}", name, expected_name_word));
  }
  describe_files("sensors", benchmark.sensors).doc("Files of further sensor profiles.");
  fields("transfer", benchmark.transfer)
      .doc("Whether fits on another robot, other sensors or the other engine are scored, too.");
  fields("refits", benchmark.refits, 0, 1000)
      .doc("Fits of ranked estimators repeated on resampled runs, for wider intervals.");
  fields("refits_everywhere", benchmark.refits_everywhere)
      .doc("Whether refits cover all robots and sensors, or the experiment's own.");
  fields("clips", benchmark.clips).doc("Whether the worst segment of every estimator is filmed.");
  fields.know("table");
  if (!fields.present("table", !benchmark.table.empty())) return;
  own_estimators(fields, "table", experiment, benchmark.table)
      .fallback("all that are ranked")
      .doc("Estimators of `benchmark_unseen.md`.");
}

StudySection benchmark_section() {
  StudySection section = optional_section<BenchmarkConfig>(
      "benchmark", "Further robots and sensors; every scene is scored separately.");
  section.files = [](const Experiment& experiment) -> StudyFiles {
    const auto* const benchmark = experiment.studies.find<BenchmarkConfig>();
    if (benchmark == nullptr) return {};
    return {.robots = benchmark->robots, .sensors = benchmark->sensors};
  };
  section.file_keys = {"benchmark.robots", "benchmark.sensors"};
  return section;
}

}  // namespace touchdown::experiments
