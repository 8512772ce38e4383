#include "core/fields.hpp"
#include "scenarios/perturbation.hpp"
#include "scenarios/scenario_file.hpp"
#include "tests/complaint.hpp"
#include "tests/scenarios/runs.hpp"

namespace touchdown::scenarios {
namespace {

using ::testing::HasSubstr;

const RandomDrive drive = {
    .velocity = 0.6, .yaw_rate = 0.8, .standing = 0.25, .hold = {0.5, 2.0}, .start = 1.0};

TEST(RandomDrive, HoldsEachCommandWithinItsRange) {
  int commands = 0;
  int standing = 0;
  for (int run = 0; run < 50; ++run) {
    const policies::VelocityScript script = random_drive(drive, 60.0, 3, run);
    ASSERT_FALSE(script.empty());
    EXPECT_EQ(script.front().time, 1.0);
    for (std::size_t i = 0; i < script.size(); ++i) {
      EXPECT_LE(std::abs(script[i].velocity), 0.6);
      EXPECT_LE(std::abs(script[i].yaw_rate), 0.8);
      EXPECT_LT(script[i].time, 60.0);
      if (i > 0) {
        EXPECT_GE(script[i].time - script[i - 1].time, 0.5);
        EXPECT_LE(script[i].time - script[i - 1].time, 2.0);
      }
      ++commands;
      standing += script[i].velocity == 0.0 && script[i].yaw_rate == 0.0 ? 1 : 0;
    }
    EXPECT_GT(script.back().time, 58.0);
  }
  EXPECT_NEAR(static_cast<double>(standing) / commands, 0.25, 0.04);
}

TEST(RandomDrive, DependsOnSeedAndRunOnlyAndALongerScriptBeginsTheSame) {
  const policies::VelocityScript one = random_drive(drive, 20.0, 3, 1);
  const policies::VelocityScript longer = random_drive(drive, 40.0, 3, 1);
  const policies::VelocityScript other = random_drive(drive, 20.0, 3, 2);
  ASSERT_GT(longer.size(), one.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].time, longer[i].time);
    EXPECT_EQ(one[i].velocity, longer[i].velocity);
  }
  EXPECT_NE(one[0].velocity, other[0].velocity);
}

TEST(RandomLifts, LiftAndPauseWithinTheirRanges) {
  const RandomLifts lifts;
  const policies::ForceScript script = random_lifts(lifts, 60.0, 3, 1);
  ASSERT_GT(script.size(), 20U);
  for (std::size_t i = 0; i < script.size(); ++i) {
    EXPECT_EQ(script[i].force.head<2>(), Eigen::Vector2d::Zero());
    EXPECT_GE(script[i].force.z(), lifts.force.low);
    EXPECT_LE(script[i].force.z(), lifts.force.high);
    EXPECT_GE(script[i].duration, lifts.hold.low);
    EXPECT_LE(script[i].duration, lifts.hold.high);
    if (i == 0) continue;
    const double pause = script[i].time - script[i - 1].time - script[i - 1].duration;
    EXPECT_GE(pause, lifts.pause.low - 1e-12);
    EXPECT_LE(pause, lifts.pause.high + 1e-12);
  }
}

const RandomCrouches crouches = {
    .hip = {-0.05, 0.27}, .exponent = 1.35, .hold = {2.0, 6.0}, .rate = 0.3, .start = 0.5};

TEST(RandomCrouches, HoldEachHeightWithinItsRange) {
  int commands = 0;
  double mean = 0.0;
  for (int run = 0; run < 200; ++run) {
    const policies::CrouchScript script = random_crouches(crouches, 60.0, 3, run);
    ASSERT_FALSE(script.empty());
    EXPECT_EQ(script.front().time, 0.5);
    EXPECT_GT(script.back().time, 54.0);
    for (std::size_t i = 0; i < script.size(); ++i) {
      EXPECT_GE(script[i].hip, -0.05);
      EXPECT_LE(script[i].hip, 0.27);
      EXPECT_EQ(script[i].rate, 0.3);
      if (i > 0) {
        EXPECT_GE(script[i].time - script[i - 1].time, 2.0);
        EXPECT_LE(script[i].time - script[i - 1].time, 6.0);
      }
      ++commands;
      mean += script[i].hip;
    }
  }
  EXPECT_NEAR(mean / commands, -0.05 + 0.32 / 2.35, 0.005);  // the mean of U^1.35 is 1/2.35
}

TEST(RandomCrouches, DependOnSeedAndRunOnlyAndALongerScriptBeginsTheSame) {
  const policies::CrouchScript one = random_crouches(crouches, 20.0, 3, 1);
  const policies::CrouchScript longer = random_crouches(crouches, 40.0, 3, 1);
  ASSERT_GT(longer.size(), one.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].time, longer[i].time);
    EXPECT_EQ(one[i].hip, longer[i].hip);
  }
  EXPECT_NE(one[0].hip, random_crouches(crouches, 20.0, 3, 2)[0].hip);
  EXPECT_NE(one[0].hip, random_crouches(crouches, 20.0, 4, 1)[0].hip);
}

TEST(RandomCrouches, ChangeNoOtherDraw) {
  Scenario scenario = standing(10.0);
  scenario.perturbation.drive = drive;
  const Scenario without = perturbed(scenario, 3, 1);
  scenario.perturbation.crouching = crouches;
  Scenario with = perturbed(scenario, 3, 1);
  EXPECT_FALSE(with.crouch.empty());
  with.crouch.clear();
  EXPECT_EQ(to_yaml(with), to_yaml(without));
}

TEST(RandomScripts, ReplaceTheVelocitiesAndAddToTheForces) {
  Scenario scenario = standing(10.0);
  scenario.velocity = {{1.0, 0.5, 0.0}};
  scenario.forces = {{.time = 0.5, .duration = 0.1, .force = {1.0, 0.0, 0.0}}};
  scenario.perturbation.drive = drive;
  scenario.perturbation.lift = RandomLifts{};
  const Scenario varied = perturbed(scenario, 3, 1);
  EXPECT_GT(varied.velocity.size(), 3U);
  EXPECT_GT(varied.forces.size(), 3U);
  EXPECT_EQ(varied.forces.front().force.x(), 1.0);
}

std::string complaint_about(const std::string& perturbation) {
  return complaint_of(
      [&] { (void)from_yaml<Perturbation>(YamlDocument::parse(perturbation, "p.yaml")); });
}

TEST(RandomScripts, ComplainOnTheLine) {
  EXPECT_THAT(complaint_about("drive:\n  hold: [2, 1]\n"),
              AllOf(HasSubstr("p.yaml:2:"), HasSubstr("[low, high]")));
  EXPECT_THAT(complaint_about("drive:\n  hold: [0, 1]\n"), HasSubstr("[low, high]"));
  EXPECT_THAT(complaint_about("crouching:\n  hip: [0.3, 0.1]\n"),
              AllOf(HasSubstr("p.yaml:2:"), HasSubstr("[low, high]")));
  EXPECT_THAT(complaint_about("crouching: {exponnt: 2}\n"), HasSubstr("did you mean 'exponent'"));
  EXPECT_THAT(complaint_about("crouching: {rate: 0}\n"), HasSubstr("rate: expected"));
  EXPECT_THAT(complaint_about("crouchingg: {rate: 1}\n"), HasSubstr("did you mean 'crouching'"));
  EXPECT_THAT(complaint_about("lift:\n  force: 3\n"), HasSubstr("p.yaml:2:"));
  EXPECT_THAT(complaint_about("lift:\n  forse: [1, 2]\n"), HasSubstr("did you mean 'force'"));
  EXPECT_THAT(complaint_about("drive:\n  standing: 1.5\n"), HasSubstr("standing: expected"));
}

TEST(RandomCrouches, AreRefusedIfTheyBendKneesBothWays) {
  const auto complaint = [](const std::string& more) -> std::string {
    return complaint_of([&] {
      (void)complete_scenario(YamlDocument::parse(
          "name: both\nrobot: " TOUCHDOWN_SOURCE_DIR "/models/upkie.xml\n" + more, "s.yaml"));
    });
  };
  const auto crouching = [](const std::string& hip) {
    return "perturbation: {crouching: {hip: " + hip + "}}\n";
  };
  EXPECT_EQ(complaint(crouching("[0.0, 0.6]")), "no complaint");
  EXPECT_EQ(complaint(crouching("[0.03, 0.28]")), "no complaint");
  EXPECT_EQ(complaint(crouching("[-0.4, -0.1]")), "no complaint");
  for (const char* hip : {"[-0.05, 0.27]", "[-0.001, 0.6]", "[-0.6, 0.001]"}) {
    EXPECT_THAT(complaint(crouching(hip)),
                AllOf(HasSubstr("perturbation.crouching.hip: expected [low, high] on one side of"),
                      HasSubstr("the knees are straight, found")))
        << hip;
  }
}

}  // namespace
}  // namespace touchdown::scenarios
