#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/documented_defaults.hpp"
#include "training/config/sample_efficiency.hpp"
#include "training/config/training.hpp"

namespace touchdown::training {
namespace {

using ::testing::IsEmpty;

TEST(TrainingKeys, HaveTheDefaultsOfAFileThatGivesNone) {
  const auto compared = tests::compared_defaults(training_keys(), to_yaml(TrainingConfig()));
  EXPECT_THAT(compared.different, IsEmpty());
  EXPECT_GT(compared.equal, 25U);
}

TEST(SampleEfficiencyKeys, HaveTheDefaultsOfAFileThatGivesNone) {
  const auto compared =
      tests::compared_defaults(sample_efficiency_keys(), to_yaml(SampleEfficiencyConfig()));
  EXPECT_THAT(compared.different, IsEmpty());
  EXPECT_GT(compared.equal, 10U);
}

}  // namespace
}  // namespace touchdown::training
