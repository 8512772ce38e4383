#include "experiments/logs/estimator.hpp"

#include <string>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/fitting/fitting.hpp"
#include "logs/model_file.hpp"
#include "tests/experiments/synthetic_runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

TEST(LogEstimator, IsTheLoadFilterUnlessAnotherIsNamed) {
  EXPECT_EQ(log_estimator({}).entry.name, "load_filter");
  EXPECT_EQ(log_estimator({}).entry.title, estimator_entry("load_filter").title);
  EXPECT_EQ(log_estimator({.name = "free_fall"}).entry.name, "free_fall");
}

TEST(LogEstimator, OfAModelHasTheTitleOfItsEntryAndNamesItsFile) {
  const ScratchFolder folder;
  const FittedModels models =
      fit_models(synthetic_experiment({"robust"}), pointers_to({synthetic_run(first_fit_run)}));
  const std::filesystem::path file = folder / "m.npz";
  logs::save_model(models.at("mujoco").at("robust"), file);
  EXPECT_EQ(log_estimator({.model = file}).entry.title,
            estimator_entry("robust").title + " (" + file.string() + ")");
}

TEST(LogEstimator, RefusesNamesThatItDoesNotKnow) {
  for (const std::string name : {"load_filer", "loadfilter", "load_filter ", "shipped"}) {
    EXPECT_THROW((void)log_estimator({.name = name}), InputError) << name;
  }
}

}  // namespace
}  // namespace touchdown::experiments
