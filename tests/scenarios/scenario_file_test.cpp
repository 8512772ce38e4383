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

TEST(ScenarioYaml, IsRefusedWithPlaceKeyAndExpectation) {
  expect_refused(
      {{"{}", {"name: is missing"}},
       {"name: x\nterain: {}\n", {"scene.yaml:2:1: terain: unknown key (did you mean 'terrain'?)"}},
       {"name: x\nend:\n  durration: 3\n", {"scene.yaml:3:3:", "did you mean 'duration'?"}},
       {"name: x\nend: {duration: -3}\n", {"duration: expected"}},
       {"name: x\nend: {duration: .nan}\n", {"duration: expected"}},
       {"name: x\nmass_scale: heavy\n", {"scene.yaml:2:13:", "expected a number"}},
       {"name: x\nbalancer: {gains: lqr}\n", {"gains"}},  // without its robot
       {"name: x\nbalancer: {gains: upki}\n", {"scene.yaml:2:19: ", "upkie"}},
       {"name: x\nbalancer: {pitch_stifness: 3}\n", {"did you mean 'pitch_stiffness'?"}},
       {"name: x\npolicy: {contact: trut}\n", {"scene.yaml:2:", "did you mean 'truth'?"}},
       {"name: x\npolicy: {law: soft}\n", {"soft_landing"}},
       {"name: x\npolicy: {delay: -1}\n", {"policy.delay"}},
       {"name: x\nvelocity:\n  - {time: 2}\n  - {time: 2}\n", {"scene.yaml:4:", "later time"}},
       {"name: x\nvelocity:\n  - {velocty: 1}\n", {"did you mean 'velocity'"}},
       {"name: x\nvelocity:\n  - {velocity: fast}\n", {"expected a number"}},
       {"name: x\nvelocity:\n  - {velocity: 99}\n", {"velocity: expected"}},
       {"name: x\nvelocity:\n  - {velocity: .nan}\n", {"velocity: expected"}},
       {"name: x\ncrouch: [{time: 2, hip: 0}, {time: 2, hip: 0}]\n", {"later time"}},
       {"name: x\ncrouch:\n  - {time: 2}\n", {"scene.yaml:3:", "hip: is missing"}},
       {"name: x\ncrouch: [{hip: 0.1, rat: 1}]\n", {"did you mean 'rate'"}},
       {"name: x\ncrouch: [{hip: 7}]\n", {"hip: expected"}},
       {"name: x\ncrouch: [{hip: 0, rate: 0}]\n", {"rate: expected"}},
       {"name: x\nforces:\n  - {force: [1, 2]}\n", {"scene.yaml:3:", "three numbers"}},
       {"name: x\nforces: [{force: [1, 2, .inf]}]\n", {"forces.0.force: expected a finite number"}},
       {"name: x\nforces: [{fource: [1, 2, 3]}]\n", {"did you mean 'force'"}},
       {"name: x\nforces: [{duration: -1}]\n", {"duration: expected"}},
       {"name: x\ntether: {lenght: 1}\n", {"scene.yaml:2:10: tether.lenght: unknown key"}},
       {"name: x\nguides: [{stifness: 3}]\n", {"did you mean 'stiffness'?"}},
       {"name: x\nsimulation:\n  physics_step_us: 300\n  control_step_us: 1000\n",
        {"scene.yaml:4:20: simulation.control_step_us: expected a multiple"}},
       {"name: x\nsimulation: {physics_step_us: 0.001}\n", {"a whole number"}},
       {"name: x\nsimulation: {physics_step_us: 0}\n", {"scene.yaml:2:"}},
       {"name: x\nsimulation: {contact: {bullet_stifness: 1}}\n",
        {"did you mean 'bullet_stiffness'"}},
       {"name: x\nsimulation: {contact: {rolling_resistance: -1}}\n", {"rolling_resistance"}},
       {"name: x\nsimulation: {contact: {rolling_resistance: .nan}}\n", {"rolling_resistance"}},
       {"name: x\nperturbation: {yav: 3}\n", {"did you mean 'yaw'?"}},
       {"name: x\nperturbation:\n  drive: {hold: [2, 1]}\n", {"scene.yaml:3:", "[low, high]"}},
       {"name: x\nperturbation: {drive: {hold: [0, 1]}}\n", {"[low, high]"}},
       {"name: x\nperturbation: {drive: {standing: 1.5}}\n", {"standing: expected"}},
       {"name: x\nperturbation: {crouching: {hip: [0.3, 0.1]}}\n", {"[low, high]"}},
       {"name: x\nperturbation: {crouching: {exponnt: 2}}\n", {"did you mean 'exponent'"}},
       {"name: x\nperturbation: {crouching: {rate: 0}}\n", {"rate: expected"}},
       {"name: x\nperturbation: {crouchingg: {rate: 1}}\n", {"did you mean 'crouching'"}},
       {"name: x\nperturbation: {lift: {force: 3}}\n", {"scene.yaml:2:"}},
       {"name: x\nperturbation: {lift: {forse: [1, 2]}}\n", {"did you mean 'force'"}},
       {"name: x\ntyre: {law: spring}\n", {"scene.yaml:2:13:", "spring_damper"}},
       {"name: x\ntyre: {stiffness: 3e4}\n", {"scene.yaml:2:", "law: spring_damper"}},
       {"name: x\nclip_crouches: deep\n", {"scene.yaml:2:16:"}},
       {"name: x\nforces_for_mas: 5\n", {"did you mean 'forces_for_mass'?"}},
       {"name: x\nforces_for_mass: -5\n", {"scene.yaml:2:18"}},
       {"name: x\ndeviatons: {com_x: 1}\n", {"did you mean 'deviations'?"}},
       {"name: x\ndeviations: {torque_error: [0, 0]}\n", {"scene.yaml:2:28", "six numbers"}}},
      parse);
  const Scenario stairs = find_scenario("scenarios/stairs.yaml");
  EXPECT_THAT(complaint_of([&] { (void)varied(stairs, "terrain.friction", -1.0, "stairs.yaml"); }),
              HasSubstr("terrain.friction"));
}

/// What the robot of a scenario cannot do, or what its file lacks.
TEST_F(ScenarioOfARobot, IsRefusedForItsRobot) {
  const std::string hip = "hip: expected -1.26 to 1.26, the range of joint 'left_hip'";
  const std::string knee = "knee: expected -2.51 to 2.51, the range of joint 'left_knee'";
  const auto crouching = [](const std::string& range) {
    return "perturbation: {crouching: {hip: " + range + "}}\n";
  };
  std::vector<Refusal> table = {
      {"balancer: {gains: lqg}\n", {"scene.yaml:3:19"}},
      {"start: {hip: 1.3, knee: 0}\n", {"start." + hip}},
      {"start: {hip: -1.3, knee: 0}\n", {"start." + hip}},
      {"start: {hip: 0, knee: 2.6}\n", {"start." + knee}},
      {"crouch: [{time: 1, hip: 1.3}]\n", {"crouch." + hip}},
      {"crouch: [{time: 1, hip: 0.2}, {time: 2, hip: -1.3}]\n", {"crouch." + hip}},
      {"perturbation: {crouching: {hip: [0, 1.4]}}\n", {"perturbation.crouching." + hip}},
  };
  for (const char* range : {"[-0.05, 0.27]", "[-0.001, 0.6]", "[-0.6, 0.001]"}) {
    table.push_back({crouching(range),
                     {"perturbation.crouching.hip: expected [low, high] on one side of",
                      "the knees are straight, found"}});
  }
  expect_refused(table, [&](const std::string& scenario) { return with("", scenario); });
  for (const char* range : {"[0.0, 0.6]", "[0.03, 0.28]", "[-0.4, -0.1]"}) {
    EXPECT_NO_THROW((void)with("", crouching(range))) << range;
  }
  EXPECT_NO_THROW((void)with("", "start: {hip: 1.25, knee: 2.5}\n"));
  EXPECT_NO_THROW((void)with("", "crouch: [{time: 1, hip: 1.25}]\n"));
  expect_refused({{"balancer: {pitch_stifness: 3}\n",
                   {"robot.yaml:2:12: balancer.pitch_stifness", "did you mean 'pitch_stiffness'?"}},
                  {"balancer: {gains: lqg}\n", {"robot.yaml:2:19", "did you mean 'lqr'?"}},
                  {"mass: 0.05\nactuators: {hip: {viscous: 10}}\nbalancer: {gains: lqr}\n",
                   {"robot.yaml:4:19: balancer.gains: lqr", "no gains are stable at this"}}},
                 [&](const std::string& robot) { return with(robot, ""); });
}

TEST_F(ScenarioOfARobot, IsRefusedForAFileThatIsMissing) {
  const std::string missing = (folder_ / "robto.yaml").string();
  folder_.write("robot.yaml", "balancer: {gains: lqr}\nmjcf: upky.xml\n");
  const auto scene_of = [&](const std::string& robot) {
    return folder_.write(robot + ".scene", "name: x\nrobot: " + (folder_ / robot).string() + "\n")
        .string();
  };
  expect_refused({{scene_of("robto.yaml"),
                   {"scene:2:8: robot: ", "robto.yaml: no such file", "robot.yaml'?)"}},
                  {scene_of("robot.yaml"), {"robot.yaml:2:7: mjcf: "}}},
                 [](const std::string& file) { return find_scenario(file); });
  EXPECT_THAT(complaint_of([&] { (void)find_scenario(scene_of("robto.yaml"), missing); }),
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
