#include "scenarios/scenario_file.hpp"

#include <cmath>
#include <filesystem>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "scenarios/generation/generate.hpp"
#include "scenarios/scenario.hpp"
#include "tests/complaint.hpp"
#include "tests/documented_defaults.hpp"
#include "tests/scenarios/runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::scenarios {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

class ScenarioOfARobot : public ::testing::Test {
 protected:
  /// A scenario with a robot file that is based on Upkie.
  Scenario with(const std::string& robot, const std::string& scenario) const {
    write_atomically(folder_ / "robot.yaml",
                     "mjcf: " TOUCHDOWN_SOURCE_DIR "/models/upkie.xml\n" + robot);
    return complete_scenario(YamlDocument::parse(
        "name: x\nrobot: " + (folder_ / "robot.yaml").string() + "\n" + scenario, "scene.yaml"));
  }

  std::string complaint_about(const std::string& robot, const std::string& scenario) const {
    return complaint_of([&] { (void)with(robot, scenario); });
  }

  ScratchFolder folder_;
};

TEST_F(ScenarioOfARobot, HasTheStanceOfTheRobotByDefault) {
  const std::string stance = "stance: {hip: 0.1, knee: 0.17}\n";
  EXPECT_EQ(with(stance, "").start.hip, 0.1);
  EXPECT_EQ(with(stance, "").start.knee, 0.17);
  EXPECT_EQ(with(stance, "start: {hip: 0.3}\n").start.hip, 0.3);
  EXPECT_EQ(with(stance, "start: {hip: 0.3}\n").start.knee, 0.17);
  EXPECT_EQ(with("", "").start.hip, 0.455);
}

TEST_F(ScenarioOfARobot, HasTheBalancerOfTheRobotByDefault) {
  const std::string gains = "balancer: {gains: upkie, max_velocity: 1.5}\n";
  EXPECT_EQ(with(gains, "").balancer.pitch_damping, 1.8);
  EXPECT_EQ(with(gains, "").balancer.max_velocity, 1.5);
  EXPECT_EQ(with(gains, "balancer: {pitch_damping: 4}\n").balancer.pitch_damping, 4.0);
  EXPECT_EQ(with(gains, "balancer: {pitch_damping: 4}\n").balancer.pitch_stiffness, 20.0);
  EXPECT_EQ(with(gains, "balancer: {gains: touchdown}\n").balancer.pitch_damping, 5.5);
  EXPECT_EQ(with(gains, "balancer: {gains: touchdown}\n").balancer.max_velocity, 1.5)
      << "not a gain, so it stays that of the robot";
}

TEST_F(ScenarioOfARobot, ComputesGainsForItsStartingStance) {
  const Scenario bent = with("balancer: {gains: lqr}\n", "");
  const Scenario straight = with("balancer: {gains: lqr}\n", "start: {hip: 0, knee: 0}\n");
  EXPECT_NEAR(bent.balancer.pitch_damping, 6.37, 0.01);
  EXPECT_GT(straight.balancer.pitch_damping, bent.balancer.pitch_damping + 0.1);
  EXPECT_EQ(with("stance: {hip: 0, knee: 0}\nbalancer: {gains: lqr}\n", "").balancer.pitch_damping,
            straight.balancer.pitch_damping);
  EXPECT_EQ(with("", "balancer: {gains: lqr}\n").balancer.pitch_damping,
            bent.balancer.pitch_damping);
  EXPECT_EQ(with("", "balancer: {gains: lqr, pitch_damping: 2}\n").balancer.pitch_damping, 2.0);
}

TEST_F(ScenarioOfARobot, IsReadBackWithoutTheRobot) {
  const Scenario scenario = with("stance: {hip: 0.1}\nbalancer: {gains: lqr}\n", "");
  std::filesystem::remove(folder_ / "robot.yaml");
  const Scenario again = scenario_from_yaml(YamlDocument::parse(to_yaml(scenario), "again.yaml"));
  EXPECT_EQ(to_yaml(again), to_yaml(scenario));
  EXPECT_EQ(again.balancer.pitch_damping, scenario.balancer.pitch_damping);
}

TEST_F(ScenarioOfARobot, ScalesForcesWrittenForUpkieToItsMass) {
  const std::string pushes =
      "forces: [{time: 1, duration: 1, force: [2, 0, 10]}]\n"
      "perturbation: {lift: {force: [53, 57]}}\n";
  const auto force_on = [&](const std::string& robot, const std::string& reference) {
    const Scenario scenario = with(robot, pushes + reference);
    EXPECT_NEAR(scenario.forces[0].force.x(), 0.2 * scenario.forces[0].force.z(), 1e-12);
    EXPECT_NEAR(scenario.perturbation.lift->force.high,
                57.0 / 53.0 * scenario.perturbation.lift->force.low, 1e-12);
    EXPECT_NEAR(scenario.perturbation.lift->force.low, 5.3 * scenario.forces[0].force.z(), 1e-12);
    return scenario.forces[0].force.z();
  };
  EXPECT_EQ(force_on("", "forces_for_mass: 5.33922\n"), 10.0) << "to the bit";
  EXPECT_NEAR(force_on("mass: 1.5\n", "forces_for_mass: 5.33922\n"), 15.0, 1e-5);
  EXPECT_NEAR(force_on("mass: 1.5\n", "forces_for_mass: 8\n"), 10.01104, 1e-5);
  EXPECT_EQ(force_on("mass: 1.5\n", ""), 10.0) << "without forces_for_mass, forces are not scaled";

  const std::string resolved = to_yaml(with("mass: 1.5\n", pushes + "forces_for_mass: 5.33922\n"));
  EXPECT_EQ(to_yaml(complete_scenario(YamlDocument::parse(resolved, "again.yaml"))), resolved)
      << "once";
}

TEST_F(ScenarioOfARobot, OfAnMjcfIsAsWritten) {
  for (const char* name : {"stairs", "roam", "hang"}) {
    const std::string file = std::string("scenarios/") + name + ".yaml";
    Scenario alone = load_scenario(TOUCHDOWN_SOURCE_DIR "/" + file);
    const Scenario found = find_scenario(file);
    alone.robot = found.robot;
    EXPECT_EQ(to_yaml(found), to_yaml(alone));
  }
}

TEST_F(ScenarioOfARobot, ThatIsMissingIsReportedWhereItIsNamed) {
  const std::string missing = (folder_ / "robto.yaml").string();
  write_atomically(folder_ / "robot.yaml", "mjcf: upkie.xml\n");
  write_atomically(folder_ / "scene.yaml", "name: x\nrobot: " + missing + "\n");
  const std::string scene = (folder_ / "scene.yaml").string();
  EXPECT_THAT([&] { (void)find_scenario(scene); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("scene.yaml:2:8: robot: "),
                                              HasSubstr("robto.yaml: no such file"),
                                              HasSubstr("robot.yaml'?)"))));
  EXPECT_THAT([&] { (void)find_scenario(scene, missing); },
              ThrowsMessage<InputError>(StartsWith(missing + ": no such file")))
      << "not named by the scenario";
}

TEST_F(ScenarioOfARobot, WithAMissingMjcfIsReportedAtTheMjcf) {
  write_atomically(folder_ / "robot.yaml", "balancer: {gains: lqr}\nmjcf: upky.xml\n");
  write_atomically(folder_ / "scene.yaml",
                   "name: x\nrobot: " + (folder_ / "robot.yaml").string() + "\n");
  EXPECT_THAT([&] { (void)find_scenario(folder_ / "scene.yaml"); },
              ThrowsMessage<InputError>(HasSubstr("robot.yaml:2:7: mjcf: ")));
}

TEST_F(ScenarioOfARobot, WithABadValueIsReportedWithTheFile) {
  EXPECT_THAT(complaint_about("balancer: {pitch_stifness: 3}\n", ""),
              AllOf(HasSubstr("robot.yaml:2:12: balancer.pitch_stifness"),
                    HasSubstr("did you mean 'pitch_stiffness'?")));
  EXPECT_THAT(complaint_about("balancer: {gains: lqg}\n", ""),
              AllOf(HasSubstr("robot.yaml:2:19"), HasSubstr("did you mean 'lqr'?")));
  EXPECT_THAT(complaint_about("", "balancer: {gains: lqg}\n"), HasSubstr("scene.yaml:3:19"));
  EXPECT_THAT(
      complaint_about("mass: 100\nbalancer: {gains: lqr}\n", ""),
      AllOf(HasSubstr("robot.yaml:3:19: balancer.gains: lqr"), HasSubstr("leg_kp_scale: ex")));
  EXPECT_THAT(complaint_about("", "deviatons: {com_x: 1}\n"),
              HasSubstr("did you mean 'deviations'?"));
  EXPECT_THAT(complaint_about("", "forces_for_mas: 5\n"),
              HasSubstr("did you mean 'forces_for_mass'?"));
  EXPECT_THAT(complaint_about("", "forces_for_mass: -5\n"), HasSubstr("scene.yaml:3:18"));
  EXPECT_THAT(complaint_about("", "deviations: {torque_error: [0, 0]}\n"),
              AllOf(HasSubstr("scene.yaml:3:28"), HasSubstr("six numbers")));
  EXPECT_THROW((void)complete_scenario(YamlDocument::parse("name: x\nrobot: no.yaml\n", "s")),
               InputError);
  // Reading a scenario alone does not read the robot.
  EXPECT_THROW(
      (void)scenario_from_yaml(YamlDocument::parse("name: x\nbalancer: {gains: lqr}\n", "s")),
      InputError);
}

Scenario parse(const std::string& text) {
  return scenario_from_yaml(YamlDocument::parse(text, "scene.yaml"));
}

std::string complaint(const std::string& text) {
  return complaint_of([&] { (void)parse(text); });
}

TEST(ScenarioYaml, EveryScenarioOfTheProjectSurvivesTheRoundTrip) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(TOUCHDOWN_SOURCE_DIR "/scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    const Scenario scenario = load_scenario(entry.path());
    EXPECT_EQ(scenario.name, entry.path().stem());
    EXPECT_EQ(to_yaml(parse(to_yaml(scenario))), to_yaml(scenario)) << scenario.name;
    const Scenario varied = perturbed(scenario, 3, 4);
    EXPECT_EQ(to_yaml(parse(to_yaml(varied))), to_yaml(varied)) << scenario.name;
    names.insert(scenario.name);
  }
  EXPECT_GE(names.size(), 8U);
}

TEST(ScenarioYaml, OnlyTheNameIsRequired) {
  const Scenario scenario = parse("name: bare\n");
  EXPECT_EQ(scenario.name, "bare");
  EXPECT_EQ(scenario.end.duration, End{}.duration);
  EXPECT_THAT(complaint("{}"), HasSubstr("name: is missing"));
}

TEST(ScenarioYaml, ComplainsOnTheLineWithTheNearestKey) {
  EXPECT_THAT(complaint("name: x\nterain: {}\n"),
              HasSubstr("scene.yaml:2:1: terain: unknown key (did you mean 'terrain'?)"));
  EXPECT_THAT(complaint("name: x\nend:\n  durration: 3\n"),
              AllOf(HasSubstr("scene.yaml:3:3:"), HasSubstr("did you mean 'duration'?")));
  EXPECT_THAT(complaint("name: x\nperturbation: {yav: 3}\n"), HasSubstr("did you mean 'yaw'?"));
  EXPECT_THAT(complaint("name: x\nguides: [{stifness: 3}]\n"),
              HasSubstr("did you mean 'stiffness'?"));
  EXPECT_THAT(complaint("name: x\nmass_scale: heavy\n"),
              AllOf(HasSubstr("scene.yaml:2:13:"), HasSubstr("expected a number")));
  EXPECT_THAT(complaint("name: x\nend: {duration: -3}\n"), HasSubstr("duration: expected"));
  EXPECT_THAT(complaint("name: x\nend: {duration: .nan}\n"), HasSubstr("duration: expected"));
}

TEST(ScenarioYaml, AMissingFileIsOneLine) {
  try {
    (void)load_scenario("/nowhere/stairs.yaml");
    FAIL() << "no complaint";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/stairs.yaml"));
    EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("\n")));
  }
}

TEST(ScenarioKeys, HaveTheDefaultsOfAFileThatGivesNone) {
  const Scenario read = scenario_from_yaml(YamlDocument::parse("name: a", "a.yaml"));
  const auto compared = tests::compared_defaults(scenario_keys(), to_yaml(read));
  EXPECT_THAT(compared.different, IsEmpty());
  EXPECT_GT(compared.equal, 45U);
}

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
