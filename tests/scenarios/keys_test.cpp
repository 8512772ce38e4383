#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenarios/scenario.hpp"
#include "tests/documented_defaults.hpp"

namespace touchdown::scenarios {
namespace {

using ::testing::IsEmpty;

TEST(ScenarioKeys, HaveTheDefaultsOfAFileThatGivesNone) {
  const Scenario read = scenario_from_yaml(YamlDocument::parse("name: a", "a.yaml"));
  const auto compared = tests::compared_defaults(scenario_keys(), to_yaml(read));
  EXPECT_THAT(compared.different, IsEmpty());
  EXPECT_GT(compared.equal, 45U);
}

}  // namespace
}  // namespace touchdown::scenarios
