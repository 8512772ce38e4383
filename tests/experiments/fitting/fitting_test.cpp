#include "experiments/fitting/fitting.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;

TEST(FitModels, FitsPhasesToSegmentsAndOtherModelsToWholeRuns) {
  const Experiment experiment = synthetic_experiment({"robust", "phase"});
  const std::vector<RunSignals> whole = {synthetic_run(first_fit_run)};
  const std::vector<RunSignals> segments = {synthetic_run(first_fit_run + 7, 2000)};
  const FittedModels without = fit_models(experiment, pointers_to(whole));
  const FittedModels with = fit_models(experiment, pointers_to(whole), pointers_to(segments));
  const auto provenance = [](const FittedModels& models) {
    return text_of_array(models.at("mujoco").at("phase").arrays.at("provenance"), "provenance");
  };
  // A fit skips the beginning of whole runs, but uses segments from their first step.
  EXPECT_THAT(provenance(without), HasSubstr("seconds: 3.700\nseed:run: 1:1000000\n"));
  EXPECT_THAT(provenance(with), HasSubstr("seconds: 2.000\nseed:run: 1:1000007\n"));
  const auto likelihood = [](const FittedModels& models) {
    return (*models.at("mujoco").at("robust").grid)({1.3, 0.3}).contact;
  };
  EXPECT_GT(likelihood(without), 0.0);
  EXPECT_EQ(likelihood(without), likelihood(with));
}

}  // namespace
}  // namespace touchdown::experiments
