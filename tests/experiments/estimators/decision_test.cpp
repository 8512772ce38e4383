#include "experiments/estimators/decision.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/signals/run_signals.hpp"
#include "tests/experiments/synthetic_runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

TEST(DecisionNetworkEntry, KeepsItsWeightsToTheBitInAFile) {
  const ScratchFolder folder;
  const EstimatorEntry entry = decision_network_entry();
  const RunSignals run = synthetic_run(1'000'000, 1500);
  const FittedModel fitted = entry.fit(entry, {.whole = {&run}});
  write_fitted_model(fitted, folder.path() / "m.npz");
  const FittedModel read = read_fitted_model(ModelKind::parameters, folder.path() / "m.npz");
  EXPECT_EQ(read.parameters->parameters, fitted.parameters->parameters);
  EXPECT_EQ(read.parameters->estimator, "decision_network");
  const RunSignals other = synthetic_run(3, 1500);
  const auto p_contact_of = [&](const FittedModel& model) {
    return predict(*entry.make(entry, {.model = &model}), other, noise_run(other, {}), {})[1]
        .p_contact;
  };
  EXPECT_EQ(p_contact_of(read), p_contact_of(fitted));
}

TEST(DecisionNetworkEntry, LearnsFromSegmentsToo) {
  const EstimatorEntry entry = decision_network_entry();
  RunSignals standing = synthetic_run(1'000'000, 600);
  RunSignals segment = synthetic_run(1'000'001, 1500);
  segment.info.scenario = "segment";
  EXPECT_THROW(entry.fit(entry, {.whole = {&standing}}), InputError);  // nothing but contact
  const FittedModel fitted = entry.fit(entry, {.whole = {&standing}, .segments = {&segment}});
  EXPECT_NE(fitted.parameters->provenance.at("scenarios").find("segment"), std::string::npos);
}

TEST(DecisionNetworkEntry, StopsOnRequest) {
  struct Asked {};
  const EstimatorEntry entry = decision_network_entry();
  const RunSignals run = synthetic_run(1'000'000, 1500);
  EXPECT_THROW(entry.fit(entry, {.whole = {&run}, .before_density = [] { throw Asked(); }}), Asked);
}

TEST(DecisionNetworkEntry, RefusesModelsWithoutALayerOrWithOtherFeatures) {
  const EstimatorEntry entry = decision_network_entry();
  const RunSignals run = synthetic_run(1'000'000, 1500);
  const recordings::ParameterModelFile good = *entry.fit(entry, {.whole = {&run}}).parameters;
  for (const char* const part : {"second_weight", "senses"}) {
    for (const bool is_missing : {true, false}) {
      recordings::ParameterModelFile file = good;
      if (is_missing) {
        file.parameters.erase(part);
      } else {
        file.parameters.at(part) = {1.0};
      }
      const FittedModel model = {
          .parameters = std::make_shared<recordings::ParameterModelFile>(std::move(file))};
      EXPECT_THROW(entry.make(entry, {.model = &model}), InputError) << part;
    }
  }
}

}  // namespace
}  // namespace touchdown::experiments
