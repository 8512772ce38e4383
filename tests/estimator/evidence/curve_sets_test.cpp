// The two sets of curves of a fit with the load by the servo law.
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/evidence/filter.hpp"
#include "estimator/models/make_estimator.hpp"
#include "estimator/models/parameters.hpp"
#include "tests/estimator/evidence/lifted_curves.hpp"
#include "tests/estimator/evidence/random_curves.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

/// The run with targets that give nearly its torques by the law.
test::CarriedRun with_targets(test::CarriedRun run) {
  test::Normal normal(11);
  for (Signals& signals : run.signals) {
    for (std::size_t side = 0; side < 2; ++side) {
      const LegSignals& leg = signals.leg[side];
      const auto target_of = [&](const JointSignals& joint) {
        return JointTarget{joint.position + joint.torque / 40.0 + 1e-3 * normal(), joint.velocity,
                           0.0, 40.0, 2.0};
      };
      signals.target[side] = {target_of(leg.hip), target_of(leg.knee), {}};
    }
  }
  return run;
}

EvidenceFitConfig shortest_fit() {
  EvidenceFitConfig config = test::brief_fit();
  config.descent.passes = 4;
  config.descent.rows = 8000;
  config.descent.epochs = 4;
  return config;
}

constexpr DecisionConfig servo_config() {
  DecisionConfig config;
  config.servo_load = true;
  return config;
}

const test::CarriedRun& fitted_run() {
  static const test::CarriedRun run = with_targets(test::lifted_run(2, 1));
  return run;
}

const EvidenceCurveSets& both_sets() {
  static const EvidenceCurveSets sets = fit_evidence_curve_sets(
      std::vector<LabelledRun>{fitted_run().view()}, servo_config(), shortest_fit());
  return sets;
}

/// What a step lacks, and whether its load by the servo law is muted then.
struct Lack {
  std::string name;
  bool is_muted;
  std::function<void(Signals&)> take;
};

std::vector<Lack> lacks() {
  return {
      {"nothing", false, [](Signals&) {}},
      {"all targets", true, [](Signals& s) { s.target = {}; }},
      {"targets of one leg", true, [](Signals& s) { s.target[1] = {}; }},
      {"one position", true, [](Signals& s) { s.target[0].hip.position = JointTarget::unknown; }},
      {"one velocity", true, [](Signals& s) { s.target[1].knee.velocity = JointTarget::unknown; }},
      {"one feedforward torque", true,
       [](Signals& s) { s.target[1].hip.feedforward_torque = HUGE_VAL; }},
      {"all gains", true,
       [](Signals& s) {
         for (LegTargets& leg : s.target) leg.hip.kp = leg.hip.kd = leg.knee.kp = leg.knee.kd = 0.0;
       }},
      {"one position gain", true, [](Signals& s) { s.target[0].knee.kp = 0.0; }},
      {"one damping", false, [](Signals& s) { s.target[0].knee.kd = 0.0; }},
      {"targets of wheels", false, [](Signals& s) { s.target[0].wheel = s.target[1].wheel = {}; }}};
}

std::vector<Belief> beliefs_of(const EvidenceCurveSets& sets, const std::vector<Signals>& signals) {
  EvidenceCurves estimator(sets);
  std::vector<Belief> beliefs;
  for (const Signals& s : signals) beliefs.push_back(estimator.update(s));
  return beliefs;
}

void expect_equal_decisions(const std::vector<Belief>& one, const std::vector<Belief>& other,
                            const std::string& what) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    for (std::size_t side = 0; side < 2; ++side) {
      ASSERT_EQ(one[k].wheel[side].p_contact, other[k].wheel[side].p_contact) << what << k;
      ASSERT_EQ(one[k].wheel[side].contact, other[k].wheel[side].contact) << what << k;
    }
  }
}

TEST(EvidenceCurveSets, AreTheFitsWithTargetsAndWithout) {
  const std::vector<LabelledRun> runs = {fitted_run().view()};
  const EvidenceModel with = fit_evidence_model(runs, servo_config(), shortest_fit());
  const EvidenceModel without = fit_evidence_model(runs, {}, shortest_fit());
  EXPECT_EQ(both_sets(), EvidenceCurveSets(with, without));
  EXPECT_EQ(fit_evidence_curve_sets(runs, {}, shortest_fit()), EvidenceCurveSets(without));
  EXPECT_STREQ(targets_of(with), "with");
  EXPECT_STREQ(targets_of(without), "without");
}

TEST(EvidenceCurveSets, BelieveWhatTheFitOfTheirSignalsBelieves) {
  const test::CarriedRun run = with_targets(test::lifted_run(1, 2, 0.3));
  for (const Lack& lack : lacks()) {
    std::vector<Signals> signals = run.signals;
    for (Signals& s : signals) lack.take(s);
    const std::vector<Belief> beliefs = beliefs_of(both_sets(), signals);
    const EvidenceModel& alone =
        lack.is_muted ? both_sets().without_targets.value() : both_sets().usual;
    expect_equal_decisions(beliefs, beliefs_of(alone, signals), lack.name);
    for (const Belief& belief : beliefs) {
      ASSERT_EQ(belief.status, lack.is_muted ? SignalStatus::degraded : SignalStatus::good)
          << lack.name;
    }
  }
}

TEST(EvidenceCurveSets, ChangeWithTheSignalsOfEachStepAndShareTheirState) {
  const test::CarriedRun run = with_targets(test::lifted_run(2, 3, 0.1));
  for (const Lack& lack : lacks()) {
    EvidenceCurves estimator(both_sets(), {.smoothing = 0.0});
    FeatureExtractor features(servo_config());
    for (std::size_t k = 0; k < run.signals.size(); ++k) {
      // Missing now and then, for one step and for most of a second.
      const bool is_missing = k % 97 == 3 || (k > 700 && k < 1500);
      Signals signals = run.signals[k];
      if (is_missing) lack.take(signals);
      const Belief& belief = estimator.update(signals);
      features.update(signals);
      features.compute_inputs();
      const bool is_muted = is_missing && lack.is_muted;
      ASSERT_EQ(belief.status == SignalStatus::degraded, is_muted) << lack.name << k;
      const EvidenceModel& model = is_muted ? *both_sets().without_targets : both_sets().usual;
      for (std::size_t side = 0; side < 2; ++side) {
        const auto logit = static_cast<double>(
            evidence_logit(model, features.inputs(side), features.servo_load(side)));
        ASSERT_NEAR(belief.wheel[side].p_contact, 1.0 / (1.0 + std::exp(-logit)), 1e-4)
            << lack.name << k;
      }
    }
  }
}

TEST(EvidenceCurveSets, RecoverWithinASecondAfterTargetsReturn) {
  const test::CarriedRun run = with_targets(test::lifted_run(2, 4));
  for (const Lack& lack : lacks()) {
    EvidenceCurves disturbed(both_sets());
    EvidenceCurves twin(both_sets());
    for (std::size_t k = 0; k < run.signals.size(); ++k) {
      Signals signals = run.signals[k];
      const Belief& expected = twin.update(signals);
      if (k >= 500 && k < 1200) lack.take(signals);
      const Belief& belief = disturbed.update(signals);
      if (k < 2200) continue;
      for (std::size_t side = 0; side < 2; ++side) {
        ASSERT_NEAR(belief.wheel[side].p_contact, expected.wheel[side].p_contact, 0.01)
            << lack.name << k;
      }
    }
  }
}

TEST(EvidenceCurveSets, OfOneModelServeStepsWithoutTargets) {
  const test::CarriedRun run = test::lifted_run(1, 5);
  const EvidenceCurveSets one = both_sets().usual;
  for (const Belief& belief : beliefs_of(one, run.signals)) {
    ASSERT_EQ(belief.status, SignalStatus::degraded);
  }
  EXPECT_NE(beliefs_of(one, run.signals).back().wheel[0].p_contact,
            beliefs_of(both_sets(), run.signals).back().wheel[0].p_contact);
}

TEST(EvidenceCurveSets, ReadBackFromAFile) {
  const Parameters both = parameters_of(both_sets());
  EXPECT_EQ(evidence_curve_sets_of(both), both_sets());
  // The names of an older file are a part of them.
  Parameters old = parameters_of(both_sets().usual);
  EXPECT_EQ(evidence_curve_sets_of(old), EvidenceCurveSets(both_sets().usual));
  for (const auto& [name, values] : old) {
    EXPECT_EQ(both.at(name), values) << name;
    EXPECT_FALSE(name.starts_with("without_targets_"));
  }
  for (const char* const part : {"without_targets_curves_load", "without_targets_seen_roll_rate",
                                 "without_targets_curves_torque_noise"}) {
    Parameters incomplete = both;
    ASSERT_EQ(incomplete.erase(part), 1U);
    EXPECT_THROW(static_cast<void>(evidence_curve_sets_of(incomplete)), InputError) << part;
  }
}

TEST(EvidenceCurveSets, RefuseSetsOfTheSameSignals) {
  const EvidenceModel with = both_sets().usual;
  const EvidenceModel without = *both_sets().without_targets;
  EXPECT_THROW(EvidenceCurves(EvidenceCurveSets(with, with)), InputError);
  EXPECT_THROW(EvidenceCurves(EvidenceCurveSets(without, without)), InputError);
  EXPECT_THROW(EvidenceCurves(EvidenceCurveSets(without, with)), InputError);
  EvidenceModel broken = without;
  broken.bias = std::nanf("");
  EXPECT_THROW(EvidenceCurves(EvidenceCurveSets(with, broken)), InputError);
  EXPECT_NO_THROW(EvidenceCurves(EvidenceCurveSets(with, without)));
}

/// The logits of random steps.
std::vector<float> logits_of(const EvidenceModel& model) {
  test::Normal normal(3);
  std::vector<float> logits;
  for (int step = 0; step < 100; ++step) {
    DecisionInputs inputs{};
    ServoLoadInputs servo{};
    for (float& x : inputs) x = static_cast<float>(3.0 * normal());
    for (float& x : servo) x = static_cast<float>(3.0 * normal());
    logits.push_back(evidence_logit(model, inputs, servo));
  }
  return logits;
}

TEST(EvidenceCurveSets, HaveAMeanWithTheMeanLogits) {
  const EvidenceCurveSets one = test::random_curve_sets(1);
  const EvidenceCurveSets other = test::random_curve_sets(5);
  for (const float weight : {0.0F, 0.3F, 1.0F}) {
    const EvidenceCurveSets mean = mean_of(one, other, static_cast<double>(weight));
    const auto expect_mean = [&](const EvidenceModel& of, const EvidenceModel& first,
                                 const EvidenceModel& second) {
      const std::vector<float> logits = logits_of(of);
      const std::vector<float> a = logits_of(first);
      const std::vector<float> b = logits_of(second);
      for (std::size_t i = 0; i < logits.size(); ++i) {
        ASSERT_NEAR(logits[i], weight * a[i] + (1.0F - weight) * b[i], 1e-4F) << weight;
      }
    };
    expect_mean(mean.usual, one.usual, other.usual);
    expect_mean(mean.without_targets.value(), *one.without_targets, *other.without_targets);
  }
  EXPECT_EQ(mean_of(one, other, 1.0).usual.curve, one.usual.curve);
  EXPECT_EQ(mean_of(one, other, 0.0).without_targets->curve, other.without_targets->curve);
}

TEST(EvidenceCurveSets, HaveAMeanOfTheSameChannelsOnly) {
  const EvidenceCurveSets both = test::random_curve_sets(1);
  const EvidenceCurveSets without = test::random_curves(4);
  const EvidenceCurveSets mean = mean_of(without, both, 0.0);
  EXPECT_EQ(mean.usual.curve, both.without_targets->curve);
  EXPECT_FALSE(mean.without_targets);
  EXPECT_THROW((void)mean_of(both, without, 0.5), InputError);
  EXPECT_THROW((void)mean_of(both, both.usual, 0.5), InputError);
  EXPECT_THROW((void)mean_of(without, both.usual, 0.5), InputError);
}

}  // namespace
}  // namespace touchdown
