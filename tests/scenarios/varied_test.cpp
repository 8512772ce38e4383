#include "scenarios/varied.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "scenarios/generation/named.hpp"
#include "scenarios/scenario_file.hpp"

namespace touchdown::scenarios {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(Varied, ChangesTheNumberUnderTheKeyAndNothingElse) {
  const Scenario stairs = find_scenario("scenarios/stairs.yaml");
  const std::string key = "terrain.pieces.1.stairs.rise";
  EXPECT_EQ(number_at(stairs, key), 0.25);
  Scenario higher = varied(stairs, key, 0.7, "stairs.yaml");
  EXPECT_EQ(number_at(higher, key), 0.7);
  EXPECT_EQ(to_yaml(varied(higher, key, 0.25, "stairs.yaml")), to_yaml(stairs));
  EXPECT_EQ(number_at(varied(stairs, "velocity.0.velocity", 0.4, "x"), "velocity.0.velocity"), 0.4);
}

TEST(Varied, HasNoNumberForUnknownKeys) {
  const Scenario stairs = find_scenario("scenarios/stairs.yaml");
  for (const char* key : {"", "terrain", "terrain.pieces.7.stairs.rise", "terrain.pieces.-1",
                          "name", "terrain.pieces.1.stairs.rise.more"}) {
    EXPECT_TRUE(std::isnan(number_at(stairs, key))) << key;
  }
}

TEST(Varied, RefusesValuesOutOfRange) {
  const Scenario stairs = find_scenario("scenarios/stairs.yaml");
  EXPECT_THAT([&] { (void)varied(stairs, "terrain.friction", -1.0, "stairs.yaml"); },
              ThrowsMessage<InputError>(HasSubstr("terrain.friction")));
}

}  // namespace
}  // namespace touchdown::scenarios
