#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/signals/run_signals.hpp"
#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

TEST(DecisionNetworkEntry, LearnsFromSegmentsToo) {
  const EstimatorEntry entry = estimator_entry("decision_network");
  RunSignals standing = synthetic_run(1'000'000, 600);
  RunSignals segment = synthetic_run(1'000'001, 1500);
  segment.info.scenario = "segment";
  EXPECT_THROW(entry.fit({.whole = {&standing}}), InputError);  // nothing but contact
  const Model fitted = entry.fit({.whole = {&standing}, .segments = {&segment}});
  EXPECT_NE(text_of_array(fitted.arrays.at("provenance"), "provenance").find("segment"),
            std::string::npos);
}

TEST(DecisionNetworkEntry, RefusesModelsWithoutALayerOrWithOtherFeatures) {
  const EstimatorEntry entry = estimator_entry("decision_network");
  const RunSignals run = synthetic_run(1'000'000, 1500);
  const Model good = entry.fit({.whole = {&run}});
  for (const char* const part : {"second_weight", "senses"}) {
    for (const bool is_missing : {true, false}) {
      Model model = good;
      if (is_missing) {
        model.arrays.erase(part);
      } else {
        model.arrays.at(part) = {{1}, {1.0}};
      }
      EXPECT_THROW(entry.make({.model = &model}), InputError) << part;
    }
  }
}

/// The run with targets that give its torques by the law.
RunSignals with_targets(RunSignals run) {
  for (Signals& signals : run.signals) {
    for (std::size_t side = 0; side < 2; ++side) {
      const LegSignals& leg = signals.leg[side];
      LegTargets& target = signals.target[side];
      target.hip = {leg.hip.position + leg.hip.torque / 40.0, leg.hip.velocity, 0.0, 40.0, 2.0};
      target.knee = {leg.knee.position + leg.knee.torque / 40.0, leg.knee.velocity, 0.0, 40.0, 2.0};
    }
  }
  return run;
}

TEST(DecisionEntries, HaveTheServoLoadIfTheirFitDoes) {
  const RunSignals run = with_targets(synthetic_run(1'000'000, 1500));
  for (const EstimatorEntry& entry : {estimator_entry("decision_network"), evidence_curves_entry(),
                                      estimator_entry("evidence_curves_quiet")}) {
    const Model with = entry.fit({.whole = {&run}, .servo_load = true});
    const Model without = entry.fit({.whole = {&run}});
    const auto has = [](const Model& model, const char* name) {
      return model.arrays.contains(name);
    };
    EXPECT_EQ(has(with, "servo_weight"), entry.name == "decision_network");
    EXPECT_EQ(has(with, "curves_servo_load"), entry.name != "decision_network");
    EXPECT_FALSE(has(without, "servo_weight") || has(without, "curves_servo_load"));
    // Curves have a second set for steps without targets.
    EXPECT_EQ(has(with, "without_targets_bias"), entry.name != "decision_network");
    EXPECT_FALSE(has(without, "without_targets_bias"));
    // A fit without the channel does not depend on targets.
    const RunSignals plain = synthetic_run(1'000'000, 1500);
    EXPECT_EQ(entry.fit({.whole = {&plain}}).arrays, without.arrays);

    const RunSignals other = with_targets(synthetic_run(3, 1500));
    const auto estimator = entry.make({.model = &with});
    const auto twin = entry.make({.model = &without});
    std::size_t agreed = 0;
    for (std::size_t k = 0; k < other.steps(); ++k) {
      Signals signals = other.signals[k];
      ASSERT_NE(estimator->update(signals).status, SignalStatus::degraded) << k;
      signals.target = {};
      ASSERT_NE(twin->update(signals).status, SignalStatus::degraded) << k;
    }
    estimator->reset();
    twin->reset();
    std::size_t degraded = 0;
    for (std::size_t k = 0; k < other.steps(); ++k) {
      Signals signals = other.signals[k];
      signals.target = {};
      const Belief& belief = estimator->update(signals);
      const Belief& of_twin = twin->update(signals);
      if (entry.name != "decision_network") {
        ASSERT_EQ(belief.wheel[1].p_contact, of_twin.wheel[1].p_contact) << entry.name << k;
      }
      degraded += belief.status == SignalStatus::degraded ? 1 : 0;
      agreed += belief.wheel[0].contact == (other.contact[0][k] != 0) ? 1 : 0;
    }
    EXPECT_EQ(degraded, other.steps()) << entry.name;
    // It still decides by its other channels.
    EXPECT_GT(static_cast<double>(agreed), 0.9 * static_cast<double>(other.steps())) << entry.name;
  }
}

}  // namespace
}  // namespace touchdown::experiments
