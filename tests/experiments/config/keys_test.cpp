#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/config/experiment.hpp"
#include "experiments/studies/experiment_file.hpp"
#include "tests/documented_defaults.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::ElementsAre;

TEST(ExperimentKeys, HaveTheDefaultsOfAFileThatGivesNone) {
  const Experiment read = experiment_from_yaml(YamlDocument::parse(
      "{name: a, fit: {scenarios: [a.yaml]}, test: {scenarios: [a.yaml]}}", "a.yaml"));
  const auto compared = tests::compared_defaults(experiment_keys(), to_yaml(read));
  EXPECT_THAT(compared.different, ElementsAre("highlights", "video.estimators"))
      << "described in words, as they depend on other keys";
  EXPECT_GT(compared.equal, 25U);
}

}  // namespace
}  // namespace touchdown::experiments
