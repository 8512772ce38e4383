#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/evidence/filter.hpp"
#include "estimator/models/make_estimator.hpp"
#include "estimator/models/parameters.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/signals/run_signals.hpp"
#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

TEST(EvidenceEntries, AreFittedWithTheChosenSmoothness) {
  const RunSignals run = synthetic_run(1'000'000, 1500);
  const EstimatorEntry entry = evidence_curves_entry();
  const EstimatorEntry other = with_hyperparameters(entry, {{"smoothness", 1e-3}});
  EXPECT_NE(evidence_in(entry.fit({.whole = {&run}})), evidence_in(other.fit({.whole = {&run}})));
}

TEST(EvidenceEntries, RefuseIncompleteModelsAndOtherFeatures) {
  const EstimatorEntry entry = evidence_curves_entry();
  const RunSignals run = synthetic_run(1'000'000, 1500);
  const Model good = entry.fit({.whole = {&run}});
  const auto refused = [&](const auto& spoil) {
    Parameters parameters = parameters_of(good.arrays);
    spoil(parameters);
    const Model model = {.arrays = arrays_of(parameters, entry.name)};
    EXPECT_THROW(entry.make({.model = &model}), InputError);
  };
  refused([](Parameters& all) { all.erase("curves_load"); });
  refused([](Parameters& all) { all.at("curves_torque_noise").pop_back(); });
  refused([](Parameters& all) { all.at("bias")[0] = HUGE_VAL; });
  refused([](Parameters& all) { all.at("senses")[0] -= 1.0; });
  refused([](Parameters& all) { all.erase("senses"); });
}

TEST(EvidenceEntries, DecideByTheThresholdsInTheirMetadata) {
  const EstimatorEntry entry = evidence_curves_entry();
  const RunSignals run = synthetic_run(1'000'000, 1500);
  const RunSignals other = synthetic_run(3, 3000);
  Model model = entry.fit({.whole = {&run}});
  const auto decisions_with = [&](const char* key, const char* value) {
    model.metadata = ModelMetadata{.estimator = entry.name,
                                   .sample_rate = 1000.0,
                                   .robot = {},
                                   .configuration = {{key, value}},
                                   .fingerprint = {}};
    const scoring::Prediction tracks =
        predict(*entry.make({.model = &model}), other, noise_run(other, {}), {});
    return std::array{tracks[0].contact, tracks[1].contact};
  };
  EXPECT_NE(decisions_with("leave_below", "0.0001"), decisions_with("leave_below", "0.9"));
  EXPECT_NE(decisions_with("return_above", "0.86"), decisions_with("return_above", "0.9999999"));
}

TEST(EvidenceEntries, ShareAFitAndDifferInTheirOperatingPoint) {
  const EstimatorEntry balanced = evidence_curves_entry();
  const EstimatorEntry quiet = estimator_entry("evidence_curves_quiet");
  EXPECT_TRUE(share_model(balanced, quiet));
  EXPECT_EQ(balanced.chosen("leave_below"), balanced_point.leave_below);
  EXPECT_EQ(quiet.chosen("leave_below"), quiet_point.leave_below);
  EXPECT_EQ(quiet.chosen("return_above"), quiet_point.return_above);
  const RunSignals run = synthetic_run(1'000'000, 1500);
  const RunSignals other = synthetic_run(3, 3000);
  // A model of either entry, with its metadata or without any, runs at the point of the entry.
  for (const EstimatorEntry& fitted : {balanced, quiet}) {
    Model model = fitted.fit({.whole = {&run}});
    for (const bool has_metadata : {false, true}) {
      if (has_metadata) {
        model.metadata = ModelMetadata{.estimator = fitted.name,
                                       .sample_rate = 1000.0,
                                       .robot = {},
                                       .configuration = default_configuration(fitted.name, 1000.0),
                                       .fingerprint = {}};
      }
      for (const EstimatorEntry& entry : {balanced, quiet}) {
        const OperatingPoint& point = entry.name == balanced.name ? balanced_point : quiet_point;
        EvidenceCurves expected(evidence_in(model).value(), {.point = point});
        EXPECT_EQ(decide(*entry.make({.model = &model}), other, noise_run(other, {}), {}),
                  decide(expected, other, noise_run(other, {}), {}))
            << fitted.name << " as " << entry.name;
      }
    }
  }
}

TEST(EvidenceIn, IsEmptyForOtherModels) {
  EXPECT_FALSE(evidence_in({}));
  EXPECT_FALSE(evidence_in({.arrays = arrays_of(Parameters{}, "force_kinematics")}));
}

}  // namespace
}  // namespace touchdown::experiments
