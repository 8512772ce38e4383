#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/fields.hpp"
#include "noise/sensors/profile.hpp"
#include "tests/documented_defaults.hpp"

namespace touchdown::noise {
namespace {

using ::testing::IsEmpty;

TEST(SensorKeys, HaveTheDefaultsOfAFileThatGivesNone) {
  const auto compared =
      tests::compared_defaults(documented_keys(SensorProfile()), to_yaml(SensorProfile()));
  EXPECT_THAT(compared.different, IsEmpty());
  EXPECT_GT(compared.equal, 80U);
}

}  // namespace
}  // namespace touchdown::noise
