#include "scenarios/generation/generate.hpp"

#include <cmath>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "core/resources.hpp"
#include "models/stance.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/generation/families.hpp"
#include "scenarios/scenario_file.hpp"
#include "tests/draws.hpp"
#include "tests/models/upkie.hpp"
#include "tests/scenarios/runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::scenarios {
namespace {

Scenario read(const GeneratedScenario& drawn, const std::string& robot = "models/upkie.xml") {
  YamlDocument document = YamlDocument::parse(drawn.text, drawn.name);
  document.override_value("robot=" TOUCHDOWN_SOURCE_DIR "/" + robot);
  return complete_scenario(document);
}

TEST(Generation, EndsWhenItIsAskedToStop) {
  int draws = 0;
  EXPECT_THROW(generate({.seed = 5, .count = 30}, [&] { return ++draws < 4; }), Stopped);
  EXPECT_EQ(draws, 4);
}

TEST(Generation, GivesTheSameFilesForTheSameSeed) {
  const auto first = generate({.seed = 5, .count = 30});
  const auto again = generate({.seed = 5, .count = 30});
  const auto other = generate({.seed = 6, .count = 30});
  const auto few = generate({.seed = 5, .count = 7});  // a shorter list begins the longer one
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i].text, first[i].text);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].text, again[i].text);
    EXPECT_NE(first[i].text, other[i].text);
  }
}

TEST(Generation, OfFewerFamiliesDrawsTheSameScenarios) {
  const auto all = generate({.seed = 5, .count = static_cast<int>(2 * families().size())});
  const auto kerbs = generate({.seed = 5, .count = 2, .families = {"kerbs"}});
  std::set<std::string> texts;
  for (const GeneratedScenario& drawn : all) texts.insert(drawn.text);
  EXPECT_EQ(texts.size(), all.size());
  for (const GeneratedScenario& drawn : kerbs) EXPECT_TRUE(texts.contains(drawn.text));
}

TEST(Generation, OfANameGivesTheScenarioOfTheFile) {
  for (const GeneratedScenario& drawn : generate({.seed = 5, .count = 16})) {
    EXPECT_EQ(generate_named(drawn_name(drawn)).text, drawn.text);
    EXPECT_EQ(find_scenario(drawn_name(drawn)).name, drawn.name);
  }
}

TEST(Generation, LeavesStanceAndGainsToTheRobot) {
  for (const GeneratedScenario& drawn : generate({.seed = 3, .count = 15})) {
    const Scenario bent = read(drawn);
    const Scenario straight = read(drawn, "models/upkie_straight.yaml");
    EXPECT_EQ(bent.start.hip, models::Stance().hip) << drawn.text;
    EXPECT_EQ(straight.start.hip, 0.1) << drawn.text;
    EXPECT_NE(straight.balancer.pitch_damping, bent.balancer.pitch_damping) << drawn.text;
  }
}

TEST(Generation, ObeysItsRulesAndBendsNoKneeBackwards) {
  for (const char* robot :
       {"models/upkie.xml", "models/upkie_straight.yaml", "models/upkie_straight_actuated.yaml"}) {
    for (const GeneratedScenario& drawn : generate({.seed = 21, .count = 66})) {
      const Scenario scenario = read(drawn, robot);
      EXPECT_EQ(scenario.name, drawn.name);
      EXPECT_FALSE(objection_to(scenario)) << drawn.text;
      for (int run = 0; run < draws(20); ++run) {
        const Scenario varied = perturbed(scenario, 5, run);
        double lowest = varied.start.knee;
        for (const policies::CrouchCommand& command : varied.crouch) {
          const double bend = command.hip - varied.start.hip;
          lowest = std::min(lowest, varied.start.knee + policies::knee_per_hip * bend);
        }
        ASSERT_GE(lowest, 1.7 * least_bend) << robot << '\n' << drawn.text;
      }
    }
  }
}

TEST(Generation, OfLiftsScalesWithTheRobotsMass) {
  const auto drawn = generate({.seed = 3, .count = 1, .families = {"slow_lifts"}});
  const Scenario upkie = read(drawn.front());
  const Scenario heavy = read(drawn.front(), "models/upkie_heavy.yaml");
  const double ratio = *heavy.forces_for_mass / *upkie.forces_for_mass;
  EXPECT_GT(ratio, 1.2);
  EXPECT_NEAR(heavy.forces[0].force.z() / upkie.forces[0].force.z(), ratio, 1e-9);
}

TEST(Generation, OfSlowLiftsGrowsAndFadesAndLifts) {
  const auto drawn = generate({.seed = 3, .count = 12, .families = {"slow_lifts"}});
  for (const GeneratedScenario& one : drawn) {
    const Scenario scenario = read(one);
    for (const policies::TimedForce& force : scenario.forces) {
      EXPECT_GE(force.rise, 0.2);
      EXPECT_LE(force.rise, 10.0);
      EXPECT_GE(force.fall, 0.2);
      EXPECT_LE(force.fall, 10.0);
    }
    EXPECT_GT(greatest_height(scenario.forces, *scenario.forces_for_mass * scenario.mass_scale,
                              scenario.end.duration),
              0.0);
  }
}

TEST(Generation, OfTyresPutsAnotherFamilysSceneOnSpringsThatScaleWithTheRobot) {
  std::set<std::size_t> pieces;
  for (const auto& [family, softest, stiffest] :
       {std::tuple("soft_tyres", 8e3, 3e4), std::tuple("hard_tyres", 3e4, 1e5)}) {
    for (const GeneratedScenario& drawn :
         generate({.seed = 3, .count = 12, .families = {family}})) {
      const Scenario scenario = read(drawn);
      ASSERT_TRUE(scenario.tyre) << drawn.text;
      EXPECT_GE(scenario.tyre->stiffness, softest);
      EXPECT_LE(scenario.tyre->stiffness, stiffest);
      EXPECT_EQ(compile_robot(scenario).tyre.stiffness, scenario.tyre->stiffness);
      const Scenario heavy = read(drawn, "models/upkie_heavy.yaml");
      const double ratio = *heavy.forces_for_mass / *scenario.forces_for_mass;
      EXPECT_GT(ratio, 1.2);
      EXPECT_NEAR(heavy.tyre->stiffness / scenario.tyre->stiffness, ratio, 1e-9);
      EXPECT_NEAR(heavy.tyre->damping / scenario.tyre->damping, ratio, 1e-9);
      pieces.insert(scenario.terrain.pieces.size() + 100 * scenario.forces.size());
    }
  }
  EXPECT_GT(pieces.size(), 4U) << "scenes of several families";
}

TEST(Generation, EndsCrouchesWithinTheRangesOfTheRobotsJoints) {
  const models::RobotModel legs =
      models::compile_robot_model(find_resource("models/five_bar.yaml"), {});
  int clipped = 0;
  for (const GeneratedScenario& drawn :
       generate({.seed = 3, .count = 24, .families = {"squats", "hops", "drives"}})) {
    const Scenario upkie = read(drawn);
    const Scenario scenario = read(drawn, "models/five_bar.yaml");
    std::vector<double> wanted;
    std::vector<double> hips;
    const auto add = [](const Scenario& of, std::vector<double>& to) {
      for (const policies::CrouchCommand& crouch : of.crouch) to.push_back(crouch.hip);
      if (const auto& random = of.perturbation.crouching) {
        to.insert(to.end(), {random->hip.low, random->hip.high});
      }
    };
    add(upkie, wanted);
    add(scenario, hips);
    ASSERT_EQ(hips.size(), wanted.size());
    for (std::size_t i = 0; i < hips.size(); ++i) {
      const double knee =
          scenario.start.knee + policies::knee_per_hip * (hips[i] - scenario.start.hip);
      EXPECT_FALSE(models::stance_error(legs, {hips[i], knee})) << drawn.text;
      if (hips[i] == wanted[i]) continue;
      ++clipped;
      const double further = hips[i] + std::copysign(0.001, wanted[i] - hips[i]);
      EXPECT_TRUE(models::stance_error(
          legs, {further, knee + policies::knee_per_hip * (further - hips[i])}))
          << "the joints reach no further\n"
          << drawn.text;
    }
  }
  EXPECT_GT(clipped, 5);
}

TEST(RandomStarts, AreWithinTheRangesOfTheRobotsJoints) {
  const ScratchFolder folder;
  for (const auto& [low, high, width] : {std::tuple(0.6, 2.5, 0.11), std::tuple(-2.5, 0.85, 0.034),
                                         std::tuple(0.78, 0.8, 0.005), std::tuple(0.0, 2.5, 0.3)}) {
    const std::filesystem::path file =
        folder.write("upkie.xml", edited_upkie({{R"x(("left_knee" axis="0 -1 0" range=)"[^"]*")x",
                                                 fmt::format("$1\"{} {}\"", -high, -low)},
                                                {R"x(("right_knee" axis="0 1 0" range=)"[^"]*")x",
                                                 fmt::format("$1\"{} {}\"", low, high)}}));
    const models::RobotModel robot = models::compile_robot_model(file, {});
    const Scenario scenario = complete_scenario(YamlDocument::parse(
        fmt::format("name: x\nrobot: {}\nperturbation: {{crouch: 0.3}}\n", file.string()), "x"));
    double largest = 0.0;
    for (int run = 0; run < 50; ++run) {
      const Start start = perturbed(scenario, 7, run).start;
      EXPECT_FALSE(models::stance_error(robot, {start.hip, start.knee})) << low << ' ' << high;
      largest = std::max(largest, std::abs(start.hip - scenario.start.hip));
    }
    EXPECT_LE(largest, width) << low << ' ' << high;
    EXPECT_GT(largest, 0.8 * width) << low << ' ' << high;
  }
}

/// Whether the run finished upright, and how long both wheels were off the ground (s).
struct Played {
  bool is_upright = false;
  double in_the_air = 0.0;
};

Played play(const GeneratedScenario& drawn, const std::string& engine) {
  const logs::Recording recording = scenarios::play(perturbed(read(drawn), 1, 0), engine, 1, 0);
  Played played{recording.info.outcome == logs::Outcome::finished, 0.0};
  for (const double flight : flights(recording, 0.01)) played.in_the_air += flight;
  return played;
}

TEST(Generation, OfEveryFamilyPlaysInBothEngines) {
  const std::set<std::string> never_in_the_air = {"drives", "squats", "pushes"};
  const std::set<std::string> lifts = {"lifts", "slow_lifts", "put_downs"};
  const std::set<std::string> may_topple = {"rockings", "rubble"};
  bool is_in_mujoco = false;
  for (const Family& family : families()) {
    const GeneratedScenario drawn = generate(family, 2, 1);
    is_in_mujoco = !is_in_mujoco;
    for (const std::string engine : {"mujoco", "bullet"}) {
      if (!draws_all() && is_in_mujoco != (engine == "mujoco")) continue;  // in turn
      const Played played = play(drawn, engine);
      EXPECT_TRUE(played.is_upright || may_topple.contains(family.name)) << drawn.text << engine;
      if (never_in_the_air.contains(family.name)) {
        EXPECT_EQ(played.in_the_air, 0.0) << drawn.text << engine;
      }
      if (lifts.contains(family.name)) {
        EXPECT_GT(played.in_the_air, 0.1) << drawn.text << engine;
      }
    }
  }
}

TEST(Generation, DrawsRandomScenesOnlyWhereTheyAreNamed) {
  const std::string random = random_scenes().name;
  const int turns = static_cast<int>(families().size());
  for (const GeneratedScenario& drawn : generate({.seed = 4, .count = 2 * turns})) {
    EXPECT_NE(drawn.family, random);
  }
  // Every one has ground that both engines accept and a robot that starts; some fly, some do not.
  int flying = 0;
  for (const GeneratedScenario& drawn : generate({.seed = 4, .count = 12, .families = {random}})) {
    Scenario scenario = read(drawn);
    EXPECT_NO_THROW(static_cast<void>(compile_robot(scenario))) << drawn.text;
    flying += play(drawn, "mujoco").in_the_air > 0.05 ? 1 : 0;
  }
  EXPECT_GE(flying, 1);
  EXPECT_LE(flying, 10);
}

TEST(Generation, CarriesPartOfTheWeightOfALightStand) {
  int on_a_rope = 0;
  for (const GeneratedScenario& drawn :
       generate({.seed = 3, .count = 12, .families = {"light_stands"}})) {
    const Scenario scenario = read(drawn);
    on_a_rope += scenario.tether ? 1 : 0;
    EXPECT_NE(scenario.tether.has_value(), !scenario.forces.empty()) << drawn.text;
    for (const policies::TimedForce& force : scenario.forces) {
      const double share = force.force.z() / (written_mass * scenario.mass_scale * scene_gravity);
      EXPECT_GT(share, 0.49) << drawn.text;
      EXPECT_LT(share, 0.98) << drawn.text;
    }
  }
  EXPECT_GT(on_a_rope, 0);
  EXPECT_LT(on_a_rope, 12);
}

TEST(Draws, DependOnSeedFamilyNumberAttemptListAndQuantity) {
  std::set<double> values;
  const auto add = [&](const Draws& draws) { values.insert(draws.between("rise", 0.0, 1.0)); };
  add(Draws(1, "stairs", 0, 0));
  add(Draws(2, "stairs", 0, 0));
  add(Draws(1, "kerbs", 0, 0));
  add(Draws(1, "stairs", 1, 0));
  add(Draws(1, "stairs", 0, 1));
  add(Draws(1, "stairs", 0, 0).of("part", 0));
  add(Draws(1, "stairs", 0, 0).of("part", 1));
  add(Draws(1, "stairs", 0, 0).of("other", 0));
  values.insert(Draws(1, "stairs", 0, 0).between("run", 0.0, 1.0));
  add(Draws(1, "stairs", 0, 0));  // the only one that is there already
  EXPECT_EQ(values.size(), 9U);
}

TEST(GreatestHeight, OfAConstantForceIsThatOfUniformAcceleration) {
  const double robot_mass = 5.0;
  const double up = 0.5;        // m/s²
  const double duration = 0.8;  // s
  policies::TimedForce force{.time = 1.0, .duration = duration};
  force.force.z() = robot_mass * (9.81 + up);
  const double velocity = up * duration;
  const double expected = 0.5 * up * duration * duration + velocity * velocity / (2.0 * 9.81);
  EXPECT_NEAR(greatest_height({force}, robot_mass, 10.0), expected, 2e-3);
  force.force.z() = 49.0;  // below the weight
  EXPECT_EQ(greatest_height({force}, robot_mass, 10.0), 0.0);
}

TEST(Rules, RejectWhatLeavesItsReachItsGroundOrItsTime) {
  Scenario scenario;
  scenario.forces_for_mass = 5.0;
  policies::TimedForce force{.time = 1.0, .duration = 2.0};
  force.force.z() = 55.0;  // 1.2 m/s² for 2 s
  scenario.forces = {force};
  scenario.end.duration = 10.0;
  ASSERT_TRUE(objection_to(scenario));
  EXPECT_NE(objection_to(scenario)->find("lifts the robot by"), std::string::npos);
  scenario.forces[0].duration = 0.5;
  EXPECT_FALSE(objection_to(scenario));
  scenario.mass_scale = 1.2;  // too heavy to be lifted
  EXPECT_FALSE(objection_to(scenario));

  Scenario jump;  // ends behind its landing
  jump.velocity = {{.time = 1.0, .velocity = 1.2}};
  jump.terrain.pieces = {models::Ramp{10.0, 0.1}, models::Step{0.1}, models::Flat{0.5}};
  EXPECT_TRUE(objection_to(jump));
  jump.terrain.pieces.back() = models::Flat{1.5};
  EXPECT_FALSE(objection_to(jump));

  Scenario minutes;
  EXPECT_FALSE(objection_to(minutes));
  minutes.end.duration = 600.0;
  EXPECT_NE(objection_to(minutes).value_or("").find("600 s"), std::string::npos);
}

}  // namespace
}  // namespace touchdown::scenarios
