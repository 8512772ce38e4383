#include "experiments/fitting/fitting.hpp"

#include <gtest/gtest.h>

#include "recordings/models/phase_model.hpp"
#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

TEST(FitModels, FitsPhasesToSegmentsAndOtherModelsToWholeRuns) {
  const Experiment experiment = synthetic_experiment({"robust", "phase"});
  const std::vector<RunSignals> whole = {synthetic_run(first_fit_run)};
  const std::vector<RunSignals> segments = {synthetic_run(first_fit_run + 7, 2000)};
  const FittedModels without = fit_models(experiment, pointers_to(whole));
  const FittedModels with = fit_models(experiment, pointers_to(whole), pointers_to(segments));
  const auto provenance = [](const FittedModels& models) {
    return models.at("mujoco").at("phase").phase->provenance;
  };
  EXPECT_EQ(provenance(without).at("seed:run"), "1:1000000");
  // A fit skips the beginning of whole runs, but uses segments from their first step.
  EXPECT_EQ(provenance(without).at("seconds"), "3.700");
  EXPECT_EQ(provenance(with).at("seed:run"), "1:1000007");
  EXPECT_EQ(provenance(with).at("seconds"), "2.000");
  const auto likelihood = [](const FittedModels& models) {
    return (*models.at("mujoco").at("robust").measurement)({1.3, 0.3}).contact;
  };
  EXPECT_GT(likelihood(without), 0.0);
  EXPECT_EQ(likelihood(without), likelihood(with));
}

}  // namespace
}  // namespace touchdown::experiments
