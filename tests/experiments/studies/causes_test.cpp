#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "core/resources.hpp"
#include "core/table.hpp"
#include "experiments/experiment_context.hpp"
#include "experiments/plan/plan.hpp"
#include "experiments/studies/cross_simulator.hpp"
#include "models/robot_model.hpp"
#include "scenarios/engine.hpp"
#include "tests/experiments/studies/study_test.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::size_t settings = 9;  // four of each engine, and wide edges

Experiment with_causes(std::vector<std::string> simulators = {"mujoco", "bullet"}) {
  Experiment experiment;
  experiment.simulators = std::move(simulators);
  experiment.intervals.bootstrap.resamples = 200;
  experiment.studies.emplace<CrossSimulatorConfig>().causes.emplace();
  return experiment;
}

/// Made-up facts: in each setting every quantity has this value, which draw i moves by i.
std::vector<std::vector<RunFacts>> made_up(const std::array<double, settings>& values) {
  std::vector<std::vector<RunFacts>> facts(settings, std::vector<RunFacts>(5));
  for (std::size_t s = 0; s < settings; ++s) {
    for (std::size_t i = 0; i < facts[s].size(); ++i) {
      for (Mean& mean : facts[s][i].quantity) mean.add(values[s] + static_cast<double>(i));
    }
  }
  return facts;
}

const CauseEffect& effect(const std::vector<CauseEffect>& all, const std::string& cause,
                          const std::string& simulator, Quantity quantity) {
  return *std::ranges::find_if(all, [&](const CauseEffect& one) {
    return one.cause == cause && one.simulator == simulator &&
           one.quantity == static_cast<std::size_t>(quantity);
  });
}

TEST(Causes, ShareTheDifferenceOfTheEnginesBetweenTyreAndSolver) {
  // By engine: own laws, half the step, one law, one law at half the step.
  const auto effects =
      cause_effects(made_up({200, 190, 80, 79, 275, 310, 81, 84, 300}), with_causes());
  struct Case {
    const char* cause;
    const char* simulator;
    double change;
  };
  for (const Case& one :
       {Case{"own laws", "both", 75}, Case{"tyre", "both", 74}, Case{"solver", "both", 1},
        Case{"tyre", "mujoco", -120}, Case{"tyre", "bullet", -194}, Case{"edge", "bullet", 25},
        Case{"step", "mujoco", -10}, Case{"step", "bullet", 35},
        Case{"step, one law", "mujoco", -1}, Case{"step, one law", "bullet", 3}}) {
    const Interval change =
        effect(effects, one.cause, one.simulator, Quantity::peak_acceleration).change;
    // Paired by draw: no resample differs.
    for (const double value : {change.estimate, change.low, change.high}) {
      EXPECT_NEAR(value, one.change, 1e-9) << one.cause;
    }
  }
  EXPECT_EQ(effects.size(), 10 * quantity_count);
}

TEST(Causes, SubtractTheFirstEngineOfTheFileAndKnowBulletsPlace) {
  const auto effects = cause_effects(made_up({275, 310, 81, 84, 200, 190, 80, 79, 300}),
                                     with_causes({"bullet", "mujoco"}));
  const auto change = [&](const char* cause, const char* simulator) {
    return effect(effects, cause, simulator, Quantity::bounces).change.estimate;
  };
  EXPECT_NEAR(change("own laws", "both"), -75, 1e-9);
  EXPECT_NEAR(change("edge", "bullet"), 25, 1e-9);
  EXPECT_NEAR(change("step", "bullet"), 35, 1e-9);
}

TEST(Causes, HaveConvergedUpToTheToleranceOfTheQuantity) {
  Experiment experiment = with_causes();
  experiment.studies.emplace<CrossSimulatorConfig>().causes =
      CausesConfig{.tolerances = {4, 6, 4, 4, 4, 4}};
  auto facts = made_up({200, 205, 80, 75, 200, 197, 80, 87, 200});
  const auto words = [&](const char* cause, const char* simulator, Quantity quantity) {
    return effect(cause_effects(facts, experiment), cause, simulator, quantity).convergence();
  };
  EXPECT_EQ(words("step", "mujoco", Quantity::flight_duration), "not converged");
  EXPECT_EQ(words("step", "mujoco", Quantity::peak_acceleration), "converged");
  EXPECT_EQ(words("step", "bullet", Quantity::flight_duration), "converged");
  EXPECT_EQ(words("step, one law", "mujoco", Quantity::descent), "not converged");
  EXPECT_EQ(words("step, one law", "bullet", Quantity::peak_acceleration), "not converged");
  EXPECT_EQ(words("own laws", "both", Quantity::flight_duration), "") << "no change of the step";
  for (RunFacts& run : facts[1]) run.quantity[0] = {};  // a run without drops
  EXPECT_EQ(words("step", "mujoco", Quantity::flight_duration), "not converged");
}

class CausesRun : public ::testing::Test {
 protected:
  CausesRun() { folder_.write("small_step.yaml", small_step_scene); }

  Experiment read(const std::string& causes) const {
    const std::string scene = (folder_ / "small_step.yaml").string();
    return experiment_from_yaml(
        YamlDocument::parse("name: causes\nestimators: [robust]\nfit: {scenarios: [" + scene +
                                "]}\ntest: {scenarios: [" + scene +
                                "], runs: 2}\nnoise: {torque: [0.25], accelerometer: [0.23]}\n"
                                "intervals: {resamples: 100}\nvideo: {enabled: "
                                "false}\ncross_simulator:\n  overlay: {drop: 0}\n  causes: " +
                                causes + "\n",
                            "causes.yaml"));
  }

  const ScratchFolder folder_;
};

/// The longest step that divides 1 ms, up to a limit (µs).
std::int64_t divisor_of_millisecond(double most) {
  std::int64_t step = 1;
  for (std::int64_t i = 1; i <= 1000 && static_cast<double>(i) <= most; ++i) {
    if (1000 % i == 0) step = i;
  }
  return step;
}

TEST_F(CausesRun, HalveTheStepThatTheTyreNeeds) {
  for (const auto& [stiffness, damping] : {std::pair{3e4, 300.0}, {1.2e5, 300.0}, {1e5, 20.0}}) {
    const RunRequest request = request_of(read(fmt::format(
        "{{runs: 1, tyre: {{stiffness: {}, damping: {}, width: 0}}}}", stiffness, damping)));
    const Plan plan = whole_plan(request);
    std::map<std::string, scenarios::Scenario> scene;
    for (const PlannedRun& run : plan.runs) scene[plan.groups[run.group].name] = run.scenario;
    const auto step = [&](const std::string& group, const char* simulator) {
      const scenarios::Scenario& planned = scene.at(group + " " + simulator);
      const auto engine = scenarios::make_simulator(planned, simulator);
      EXPECT_EQ(engine->options().steps.control_us, 1000);
      return engine->options().steps.physics_us;
    };
    const auto model = scenarios::compile_scene(scene.at("one_law bullet"));
    double wheel = 1e9;  // kg
    for (const int tyre : model->tyre_geom) {
      wheel = std::min(wheel, model->mj->body_mass[model->mj->geom_bodyid[tyre]]);
    }
    const std::int64_t full = divisor_of_millisecond(
        1e6 * std::min(0.3 * std::sqrt(wheel / stiffness), damping / stiffness));
    for (const char* simulator : {"mujoco", "bullet"}) {
      EXPECT_EQ(step("half_step", simulator), 500);
      EXPECT_EQ(step("one_law", simulator), full);
      EXPECT_EQ(step("one_law_half_step", simulator),
                divisor_of_millisecond(0.5 * static_cast<double>(full)));
    }
    EXPECT_EQ(step("wide_edges", "bullet"), 1000);
    EXPECT_DOUBLE_EQ(scene.at("wide_edges bullet").simulation.contact.bullet_edge_radius, 0.04);
    EXPECT_DOUBLE_EQ(scene.at("").simulation.contact.bullet_edge_radius, 1e-4);
  }
}

TEST_F(CausesRun, GiveBothEnginesATyreThatSagsUnderTheWeight) {
  const auto height = [&](double stiffness, const char* simulator) {
    const Plan plan = whole_plan(request_of(
        read(fmt::format("{{runs: 1, tyre: {{stiffness: {}, damping: 200}}}}", stiffness))));
    scenarios::Scenario scene =
        plan.runs[plan.runs_in(*plan.group_called(std::string("one_law ") + simulator)).front()]
            .scenario;
    scene.velocity = {};
    scene.end = {.duration = 4.0};
    const logs::Recording run = scenarios::play(scene, simulator);
    return std::accumulate(run.truth.end() - 1000, run.truth.end(), 0.0,
                           [](double sum, const models::GroundTruth& truth) {
                             return sum + 1e-3 * truth.base_position.z();
                           });
  };
  const models::RobotModel upkie =
      models::compile_robot_model(find_resource("models/upkie.xml"), {});
  const double mass = mj_getTotalmass(upkie.mj.get());
  const auto sag = [&](double stiffness) { return 0.5 * mass * 9.81 / stiffness; };
  for (const char* simulator : {"mujoco", "bullet"}) {
    EXPECT_NEAR(height(4e4, simulator) - height(5e3, simulator), sag(5e3) - sag(4e4),
                0.02 * sag(5e3))
        << simulator;
  }
}

TEST_F(CausesRun, AgreeWithTheOtherTablesAndMarkWhatHasNotConverged) {
  const std::string causes =
      "{runs: 2, tolerances: {flight_duration: 1000, peak_acceleration: 0, edge_contacts: 2, "
      "bounces: 20, contact_ratio: 1, descent: 10}}";
  expect_same_in_shards(folder_, read(causes), 2, {"tables/causes.csv"});
  const auto table = [&](const char* name) {
    return from_csv(read_file(folder_ / "whole/tables" / name)).rows;
  };
  const auto rows = table("causes.csv");
  ASSERT_EQ(rows.size(), 10 * quantity_count);
  const auto change = [&](const std::string& quantity, const std::string& cause) {
    return std::stod((*std::ranges::find_if(
        rows, [&](const auto& row) { return row[0] == quantity && row[2] == cause; }))[4]);
  };
  for (const auto& row : table("agreement.csv")) {
    EXPECT_NEAR(std::stod(row[8]), change(row[0], "own laws"), 1e-6) << row[0];
    EXPECT_NEAR(change(row[0], "tyre") + change(row[0], "solver"), change(row[0], "own laws"),
                1e-6);
  }
  // Own laws, tyre, solver and two steps in each engine; edges in Bullet.
  EXPECT_EQ(table("cause_costs.csv").size(), 11U);
  for (const auto& row : rows) {
    if (!row[2].starts_with("step")) {
      EXPECT_EQ(row[7], "") << row[2];
    } else {
      EXPECT_EQ(row[7], row[0].starts_with("peak") ? "not converged" : "converged") << row[0];
    }
  }
  EXPECT_THAT(read_file(folder_ / "whole/tables/cross_simulator.md"),
              AllOf(HasSubstr("not converged"), HasSubstr("tolerance 1000"), HasSubstr("solver")));
}

TEST_F(CausesRun, AreReadBack) {
  EXPECT_THAT(reread_yaml(read("{runs: 1, tolerances: {bounces: 0.5}}")),
              AllOf(HasSubstr("bounces: 0.5"), HasSubstr("law: spring_damper")));
  EXPECT_THAT(reread_yaml(read("{}")), HasSubstr("runs: 2")) << "as many as there are";
}

}  // namespace
}  // namespace touchdown::experiments
