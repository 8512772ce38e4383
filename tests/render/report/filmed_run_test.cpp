#include "render/report/filmed_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/config/experiment.hpp"
#include "experiments/estimators/registry.hpp"
#include "logs/signals_from.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/generation/generate.hpp"
#include "scenarios/leg_geometry.hpp"
#include "scenarios/scenario_file.hpp"

namespace touchdown::render {
namespace {

using ::testing::ElementsAreArray;
using ::testing::Not;

/// p(contact) of the left wheel by an estimator that knows these legs.
std::vector<float> left_beliefs(const std::string& name, const logs::Recording& recording,
                                const LegGeometry& legs) {
  const experiments::EstimatorEntry& entry = experiments::estimator_entry(name);
  const auto estimator = entry.make({.sample_rate = 1.0 / recording.period(), .legs = legs});
  std::vector<float> beliefs;
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    const Signals signals =
        logs::signals_from(recording.observation[k], k > 0 ? &recording.action[k - 1] : nullptr);
    beliefs.push_back(static_cast<float>(estimator->update(signals).wheel[0].p_contact));
  }
  return beliefs;
}

TEST(FilmedRun, GivesEstimatorsTheLegsOfItsRobot) {
  for (const std::string robot : {"knee_and_wheel", "upkie_long_legs", "upkie_heavy"}) {
    YamlDocument document = scenarios::scenario_document("scenarios/hop.yaml");
    document.override_value("robot=models/" + robot + ".yaml");
    document.override_value("end.duration=3.0");
    const scenarios::Scenario scenario = scenarios::complete_scenario(document);
    const logs::Recording recording = scenarios::play(scenario, "mujoco");
    const LegGeometry legs =
        scenarios::leg_geometry(*scenarios::CompiledScenes().as_described(scenario));
    const std::string estimator = "load_filter";
    experiments::Experiment experiment;
    experiment.estimators = {estimator};
    const FilmedRun film = filmed(recording, experiment, {}, {estimator}, {}, {});
    ASSERT_EQ(film.beliefs.size(), 1U);
    const std::vector<float>& drawn = film.beliefs.front().p_contact[0];
    EXPECT_THAT(drawn, ElementsAreArray(left_beliefs(estimator, recording, legs))) << robot;
    EXPECT_THAT(drawn, Not(ElementsAreArray(left_beliefs(estimator, recording, {})))) << robot;
  }
}

}  // namespace
}  // namespace touchdown::render
