#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/models/make_estimator.hpp"
#include "models.hpp"
#include "tests/complaint.hpp"

namespace touchdown {
namespace {

using ::testing::HasSubstr;

const LegGeometry long_legs = {.upper_length = 0.25, .lower_mass = 0.5, .robot_mass = 7.0};

/// P(contact) and the known loads of both wheels at every step of a run.
std::vector<double> beliefs_of(const ModelArrays& arrays, const ModelUse& use = {}) {
  const auto estimator = make_estimator(arrays, use);
  std::vector<double> all;
  for (const Signals& s : test::drops_on_bent_legs(1100)) {
    for (const WheelBelief& wheel : estimator->update(s).wheel) {
      all.push_back(wheel.p_contact);
      if (std::isfinite(wheel.load.force)) all.push_back(wheel.load.force);
    }
  }
  return all;
}

ModelArrays adapted(const ModelArrays& arrays, const ModelUse& use) {
  return arrays_of(model_for(model_of(arrays), use));
}

std::string complaint(const ModelArrays& arrays, const ModelUse& use) {
  return complaint_of([&] { adapted(arrays, use); });
}

TEST(ModelFor, AnotherRobotStoresItsLegs) {
  const ModelArrays upkies = test::fitted_model("load_filter");
  const ModelArrays own = adapted(upkies, {.robot = "stilts", .geometry = long_legs});
  EXPECT_EQ(beliefs_of(own), beliefs_of(upkies, {.geometry = long_legs}));
  EXPECT_NE(beliefs_of(own), beliefs_of(upkies));
  EXPECT_EQ(beliefs_of(own, {.robot = "stilts"}), beliefs_of(own));
  EXPECT_THROW(make_estimator(own, {.robot = "upkie"}), InputError);
  EXPECT_NE(metadata_of(own)->fingerprint, metadata_of(upkies)->fingerprint);
  EXPECT_EQ(beliefs_of(adapted(own, {.robot = "upkie", .geometry = LegGeometry{}})),
            beliefs_of(upkies));
}

TEST(ModelFor, AnotherConfigurationKeepsTheRest) {
  const ModelArrays usual = test::fitted_model("load_filter");
  const ModelUse use = {.configuration = {{"leave_below", "0.25"}}};
  const ModelArrays quiet = adapted(usual, use);
  const ModelMetadata metadata = *metadata_of(quiet);
  EXPECT_EQ(metadata.configuration.at("leave_below"), "0.25");
  EXPECT_EQ(metadata.configuration.at("return_above"),
            metadata_of(usual)->configuration.at("return_above"));
  EXPECT_EQ(metadata.robot, "upkie");
  EXPECT_EQ(beliefs_of(quiet), beliefs_of(usual, use));
}

TEST(ModelFor, NoRequirementIsTheModel) {
  const ModelArrays arrays = test::fitted_model("robust");
  EXPECT_EQ(metadata_of(adapted(arrays, {})), metadata_of(arrays));
  EXPECT_EQ(metadata_of(adapted(arrays, {"robust", 1000.0, "upkie"})), metadata_of(arrays));
}

TEST(ModelFor, AModelWithoutMetadataAddsThem) {
  const ModelArrays grid = test::fitted_arrays("robust");
  const ModelMetadata metadata =
      *metadata_of(adapted(grid, {.estimator = "robust", .sample_rate = 500.0, .robot = "tall"}));
  EXPECT_EQ(metadata.estimator, "robust");
  EXPECT_EQ(metadata.sample_rate, 500.0);
  EXPECT_EQ(metadata.robot, "tall");
  EXPECT_EQ(metadata.configuration, default_configuration("robust", 500.0));
}

TEST(ModelFor, AMismatchIsAnError) {
  const ModelArrays loads = test::fitted_model("load_filter");
  EXPECT_THAT(complaint(test::fitted_model("robust"), {.robot = "stilts", .geometry = long_legs}),
              HasSubstr("'robust' uses no kinematics"));
  EXPECT_THAT(complaint(loads, {.robot = "stilts"}), HasSubstr("not to 'stilts'"))
      << "the legs of that robot are unknown";
  EXPECT_THAT(complaint(loads, {.sample_rate = 50.0}),
              HasSubstr("serves 100 to 20000 Hz, not at 50 Hz"));
  EXPECT_THAT(complaint(loads, {.configuration = {{"leave_bellow", "0.25"}}}),
              HasSubstr("has no 'leave_bellow' (did you mean 'leave_below'?)"));
  EXPECT_THAT(complaint(loads, {.configuration = {{"leave_below", "often"}}}),
              HasSubstr("leave_below: 'often' is no value"));
  EXPECT_THAT(complaint(loads, {.geometry = LegGeometry{.robot_mass = 0.0}}),
              HasSubstr("robot_mass: expected a positive number, found 0"));
  EXPECT_THAT(complaint(loads, {.robot = "two\nlines", .geometry = long_legs}),
              HasSubstr("expected a name of one line"));
}

}  // namespace
}  // namespace touchdown
