#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/documented_defaults.hpp"
#include "training/config/training.hpp"

namespace touchdown::training {
namespace {

using ::testing::IsEmpty;

TEST(TrainingKeys, HaveTheDefaultsOfAFileThatGivesNone) {
  const auto compared = tests::compared_defaults(training_keys(), to_yaml(TrainingConfig()));
  EXPECT_THAT(compared.different, IsEmpty());
  EXPECT_GT(compared.equal, 25U);
}

}  // namespace
}  // namespace touchdown::training
