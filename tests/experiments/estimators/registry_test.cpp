#include "experiments/estimators/registry.hpp"

#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace touchdown::experiments {
namespace {

TEST(Registry, HasUniqueNamesAndCompleteEntries) {
  std::set<std::string> names;
  for (const EstimatorEntry& entry : estimator_entries()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_FALSE(entry.title.empty()) << entry.name;
    EXPECT_FALSE(entry.summary.empty()) << entry.name;
    EXPECT_FALSE(entry.reason.empty()) << entry.name;
    EXPECT_NE(entry.making.by_step, nullptr) << entry.name;
    EXPECT_EQ(&estimator_entry(entry.name), &entry);
  }
  EXPECT_TRUE(names.contains(std::string(always_contact_name)));
  EXPECT_THROW(estimator_entry("rubust"), InputError);
  EXPECT_THROW(estimator_entry("paper_grid"), InputError);  // of the ablation study
}

TEST(Registry, StatesWhatEstimatorsAreGiven) {
  const auto given = [](const char* name) { return given_text(estimator_entry(name)); };
  EXPECT_EQ(given("load_filter"), "geometry, mass, targets");
  EXPECT_EQ(given("free_fall"), "signals");
  EXPECT_EQ(given("robust"), "signals; fitted");
  EXPECT_EQ(given("nmn"), "signals; fitted elsewhere");
}

TEST(Registry, NoiseCountsOnlyOnTheSensorsThatAreUsed) {
  const noise::SensorNoise all{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  EXPECT_EQ(noise_of({}, all), noise::SensorNoise{});
  EXPECT_EQ(noise_of({true, true, true, true, true, true}, all), all);
  EXPECT_EQ(noise_of({.hip_torque = true}, all), noise::SensorNoise{.hip_torque = 6.0});
  EXPECT_EQ(noise_of({.wheel_torque = true, .joint_velocity = true}, all),
            (noise::SensorNoise{.wheel_torque = 2.0, .joint_velocity = 5.0}));
}

}  // namespace
}  // namespace touchdown::experiments
