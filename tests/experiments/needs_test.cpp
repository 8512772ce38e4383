#include "experiments/needs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/experiment_context.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Experiment loaded_experiment(const std::string& assignment) {
  YamlDocument document = YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/experiments/stairs.yaml");
  document.override_value(assignment);
  return experiment_from_yaml(document);
}

TEST(Needs, ApproximateThePlan) {
  for (const char* file : {"stairs", "cross_simulator", "tables"}) {
    const RunRequest request = request_of(experiment_from_yaml(
        YamlDocument::load(std::string(TOUCHDOWN_SOURCE_DIR "/experiments/") + file + ".yaml")));
    const Needs needs = needs_of(request);
    const Plan plan = whole_plan(request);
    // Needs omit the few runs that studies add.
    EXPECT_LE(needs.runs, static_cast<double>(plan.runs.size())) << file;
    EXPECT_GE(needs.runs, 0.4 * static_cast<double>(plan.runs.size())) << file;
    EXPECT_LE(needs.parts, static_cast<double>(plan.tasks.size())) << file;
    EXPECT_GE(needs.parts, 0.75 * static_cast<double>(plan.tasks.size())) << file;
  }
}

TEST(Needs, NameTheSettingsToLowerIfMemoryIsTooSmall) {
  const RunRequest few = request_of(loaded_experiment("seed=3"));
  EXPECT_NO_THROW(require_memory(few, 1.0, 4e9));
  const RunRequest many = request_of(loaded_experiment("noise.seeds=100000"));
  EXPECT_THAT([&] { require_memory(many, 0.0, 1e8); },
              ThrowsMessage<Error>(AllOf(HasSubstr("noise.seeds=100000"),
                                         HasSubstr("this process may use 0.1 GB"),
                                         HasSubstr("lower test.runs or noise.seeds"))));
  const RunRequest longer = request_of(loaded_experiment("test.runs=100000"));
  EXPECT_THAT([&] { require_memory(longer, 1.0, 4e9); },
              ThrowsMessage<Error>(AllOf(HasSubstr("test.runs=100000"), HasSubstr("--shard"))));
  EXPECT_NO_THROW(require_memory(longer, 1e-5, 4e9));
}

TEST(Needs, LeaveOutSignalsThatLeaveTheMemoryAfterTheirEvaluation) {
  const auto of_many_runs = [](const std::string& studies) {
    return request_of(experiment_from_yaml(
        YamlDocument::parse("name: many\nfit: {scenarios: [scenarios/stairs.yaml]}\n"
                            "test: {scenarios: [scenarios/stairs.yaml], runs: 20000}\n"
                            "recordings: none\nvideo: {enabled: false}\n" +
                                studies,
                            "many.yaml")));
  };
  EXPECT_NO_THROW(require_memory(of_many_runs("benchmark: {clips: true}\n"), 1.0, 4e9));
  for (const char* studies : {"", "benchmark: {}\nmoments: true\n"}) {
    EXPECT_THROW(require_memory(of_many_runs(studies), 1.0, 4e9), Error) << studies;
  }
}

TEST(Needs, CountPartsInWholeDiskBlocks) {
  const RunRequest request = request_of(loaded_experiment("seed=3"));
  const Plan plan = whole_plan(request);
  const double parts = disk_needs(plan, request.experiment).parts;
  EXPECT_GE(parts, 4096.0 * static_cast<double>(plan.tasks.size()));
  EXPECT_LE(parts, 1e6 * static_cast<double>(plan.tasks.size()));
}

}  // namespace
}  // namespace touchdown::experiments
