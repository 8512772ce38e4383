#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/plan/request.hpp"
#include "experiments/studies/experiment_file.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

YamlDocument document(const std::string& scenarios) {
  return YamlDocument::parse(
      "name: drawn\nfit: {scenarios: [scenarios/stairs.yaml]}\ntest:\n  runs: 1\n" + scenarios,
      "drawn.yaml");
}

Experiment with(const std::string& scenarios) { return experiment_from_yaml(document(scenarios)); }

TEST(DrawnScenarios, StandBehindTheFilesOfAnExperiment) {
  const Experiment experiment = with(
      "  scenarios: {files: [scenarios/flat.yaml], generate: {seed: 7, count: 3, families: [kerbs, "
      "lifts]}}\n");
  EXPECT_THAT(experiment.test.scenarios, ElementsAre("scenarios/flat.yaml", "drawn:kerbs_7_000",
                                                     "drawn:lifts_7_000", "drawn:kerbs_7_001"));
}

TEST(DrawnScenarios, AreWrittenByNameAndReadBackToTheSameRequest) {
  const Experiment experiment = with("  scenarios: {generate: {seed: 7, count: 4}}\n");
  const Experiment again =
      experiment_from_yaml(YamlDocument::parse(to_yaml(experiment), "config.yaml"));
  EXPECT_EQ(again.test.scenarios, experiment.test.scenarios);
  EXPECT_EQ(request_of(again).id, request_of(experiment).id);
  EXPECT_NE(request_of(with("  scenarios: {generate: {seed: 8, count: 4}}\n")).id,
            request_of(experiment).id);
}

TEST(DrawnScenarios, MayBeListedByName) {
  EXPECT_THAT(with("  scenarios: [drawn:hops_2_010]\n").test.scenarios,
              ElementsAre("drawn:hops_2_010"));
  const YamlDocument listed = document("  scenarios: [drawn:hops_2_010, scenarios/flat.yaml]\n");
  EXPECT_NO_THROW(require_files(listed));
}

TEST(DrawnScenarios, ThatCannotBeDrawnAreReportedWhereTheyStand) {
  EXPECT_THAT(
      [] { with("  scenarios: [drawn:hop_2_010]\n"); },
      ThrowsMessage<InputError>(HasSubstr("drawn.yaml:5:14: test.scenarios: there is no "
                                          "family of scenarios 'hop' (did you mean 'hops'?)")));
  EXPECT_THAT([] { with("  scenarios: {generate: {families: [kerb]}}\n"); },
              ThrowsMessage<InputError>(HasSubstr("did you mean 'kerbs'?")));
  EXPECT_THAT([] { with("  scenarios: {generate: {count: 0}}\n"); },
              ThrowsMessage<InputError>(HasSubstr("test.scenarios.generate.count")));
  EXPECT_THAT([] { with("  scenarios: {generat: {count: 2}}\n"); },
              ThrowsMessage<InputError>(HasSubstr("did you mean 'generate'?")));
  EXPECT_THAT([] { with("  scenarios: {}\n"); },
              ThrowsMessage<InputError>(HasSubstr("test.scenarios")));
  EXPECT_THAT([] { require_files(document("  scenarios: {files: [scenarios/flt.yaml]}\n")); },
              ThrowsMessage<InputError>(HasSubstr("did you mean 'scenarios/flat.yaml'?")));
}

}  // namespace
}  // namespace touchdown::experiments
