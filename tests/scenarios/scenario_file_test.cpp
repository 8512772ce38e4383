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

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

class ScenarioOfARobot : public ::testing::Test {
 protected:
  /// A scenario with a robot file that is based on Upkie.
  Scenario with(const std::string& robot, const std::string& scenario) const {
    write_atomically(folder_ / "robot.yaml",
                     "mjcf: " TOUCHDOWN_SOURCE_DIR "/models/upkie.xml\n" + robot);
    return complete_scenario(YamlDocument::parse(
        "name: x\nrobot: " + (folder_ / "robot.yaml").string() + "\n" + scenario, "scene.yaml"));
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
    Scenario alone = scenario_from_yaml(YamlDocument::load(TOUCHDOWN_SOURCE_DIR "/" + file));
    const Scenario found = find_scenario(file);
    alone.robot = found.robot;
    EXPECT_EQ(to_yaml(found), to_yaml(alone));
  }
}

Scenario parse(const std::string& text) {
  return scenario_from_yaml(YamlDocument::parse(text, "scene.yaml"));
}

TEST(ScenarioYaml, EveryScenarioOfTheProjectSurvivesTheRoundTrip) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(TOUCHDOWN_SOURCE_DIR "/scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    const Scenario scenario = scenario_from_yaml(YamlDocument::load(entry.path()));
    EXPECT_EQ(scenario.name, entry.path().stem());
    EXPECT_EQ(to_yaml(parse(to_yaml(scenario))), to_yaml(scenario)) << scenario.name;
    const Scenario varied = perturbed(scenario, 3, 4);
    EXPECT_EQ(to_yaml(parse(to_yaml(varied))), to_yaml(varied)) << scenario.name;
    names.insert(scenario.name);
  }
  EXPECT_GE(names.size(), 8U);
}

/// A value other than its default under every key that a shipped scenario leaves out.
constexpr const char* unusual = R"(name: unusual
tyre: {law: spring_damper, stiffness: 3e4, damping: 90, width: 0.03}
clip_crouches: true
policy: {law: soft_landing, contact: script, delay: 0.25, contact_script: [{time: 1, left: false}]}
velocity: [{time: 0.1, velocity: 0.30000000000000004}, {time: 2, yaw_rate: -0.7}]
crouch: [{time: 2, hip: 0.3, rate: 0.2}]
tether: {anchor: [0.1, -0.2, 2.5], point_in_base: [0, 0, 0.1], length: 1.1, stiffness: 9, damping: 5}
guides: [{x: 1, y: 2, point_in_base: [0.1, 0.2, 0.3], stiffness: 4, damping: 5}]
forces:
  - {time: 1.5, duration: 0.4, rise: 0.1, fall: 0.2, force: [1, 2.5, -3], along_heading: true}
  - {time: 0}
simulation:
  physics_step_us: 250
  control_step_us: 2000
  contact: {solref_time_constant: 0.02, solref_damping_ratio: 0.9, bullet_stiffness: 2e4,
            bullet_damping: 500, bullet_edge_radius: 0.04, rolling_resistance: 0.001}
)";

TEST(ScenarioYaml, KeepsEveryNumberToTheBit) {
  const Scenario scenario = parse(unusual);
  EXPECT_EQ(to_yaml(parse(to_yaml(scenario))), to_yaml(scenario));
  const Scenario again = parse(to_yaml(scenario));
  EXPECT_EQ(again.policy, scenario.policy);
  EXPECT_EQ(again.policy.contact_script.at(0).left, false);
  EXPECT_EQ(again.velocity.at(0).velocity, 0.1 + 0.2);
  EXPECT_EQ(again.velocity.at(1).yaw_rate, -0.7);
  EXPECT_EQ(again.crouch.at(0).rate, 0.2);
  EXPECT_EQ(again.tether->anchor, Eigen::Vector3d(0.1, -0.2, 2.5));
  EXPECT_EQ(again.tether->damping, 5.0);
  EXPECT_EQ(again.guides.at(0).point_in_base, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(again.forces.at(0).force, Eigen::Vector3d(1.0, 2.5, -3.0));
  EXPECT_EQ(again.forces.at(0).fall, 0.2);
  EXPECT_TRUE(again.forces.at(0).along_heading);
  EXPECT_EQ(again.simulation.steps.physics_us, 250);
  EXPECT_EQ(again.simulation.contact.rolling_resistance, 0.001);
  const Scenario bare = parse("name: bare\n");  // only the name is required
  EXPECT_EQ(bare.end.duration, End{}.duration);
  Scenario own = bare;
  own.tyre = models::Tyre{};  // the engines' law, on a robot with rubber tyres
  EXPECT_EQ(parse(to_yaml(own)).tyre->law, models::Tyre::Law::engine);
  EXPECT_THAT(to_yaml(bare), Not(AnyOf(HasSubstr("policy"), HasSubstr("com_x"), HasSubstr("tyre"),
                                       HasSubstr("clip"))));
}

TEST_F(ScenarioOfARobot, IsRefusedForARobotThatIsGivenAndMissing) {
  const std::string missing = (folder_ / "robto.yaml").string();
  const std::string scene = folder_.write("scene.yaml", "name: x\nrobot: robto.yaml\n").string();
  EXPECT_THAT(complaint_of([&] { (void)find_scenario(scene, missing); }),
              StartsWith(missing + ": no such file"))
      << "not named by the scenario";
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

}  // namespace
}  // namespace touchdown::scenarios
