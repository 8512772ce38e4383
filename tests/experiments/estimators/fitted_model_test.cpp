#include "experiments/estimators/fitted_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/stop.hpp"
#include "estimator/models/make_estimator.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/signals/reserved_seeds.hpp"
#include "logs/model_file.hpp"
#include "tests/complaint.hpp"
#include "tests/experiments/synthetic_runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

std::vector<std::string> fitted_estimators() {
  std::vector<std::string> names;
  for (const EstimatorEntry& entry : all_estimator_entries()) {
    if (entry.fits()) names.push_back(entry.name);
  }
  return names;
}

TEST(FittedModel, GivesTheSameBeliefsAfterReadingItsFile) {
  const ScratchFolder folder;
  const RunSignals run = synthetic_run(3);
  const NoiseRun noise = noise_run(run, {});
  const FittedModels models = fit_models(synthetic_experiment(fitted_estimators()),
                                         pointers_to({synthetic_run(first_fit_run)}));
  for (const std::string& name : fitted_estimators()) {
    const EstimatorEntry& entry = any_estimator_entry(name);
    const Model& fitted = models.at("mujoco").at(name);
    logs::save_model(fitted, folder / "m.npz");
    const Model read = load_model(folder / "m.npz");
    const auto p_contact_of = [&](ContactEstimator& estimator) {
      return predict(estimator, run, noise, {})[0].p_contact;
    };
    const std::vector<double> expected = p_contact_of(*entry.make({.model = &fitted}));
    const std::vector<double> found = p_contact_of(*entry.make({.model = &read}));
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-6);
    EXPECT_EQ(p_contact_of(*load_estimator(folder / "m.npz")), found) << "as a robot loads it";
    EXPECT_EQ(load_metadata(folder / "m.npz").estimator, name);
    EXPECT_EQ(load_metadata(folder / "m.npz").sample_rate, 1000.0);
    EXPECT_EQ(read.metadata->fingerprint.size(), 16U);
    const auto [least, most] = std::minmax_element(found.begin(), found.end());
    EXPECT_GT(*most - *least, 0.5) << name;
  }
}

TEST(EveryEstimator, StartsAnewAfterAReset) {
  const RunSignals run = synthetic_run(3, 1500);
  const NoiseRun noise = noise_run(run, {.seed = 2});
  const FittedModels models = fit_models(synthetic_experiment(fitted_estimators()),
                                         pointers_to({synthetic_run(first_fit_run)}));
  for (const EstimatorEntry& entry : all_estimator_entries()) {
    const auto estimator =
        entry.make({.model = entry.fits() ? &models.at("mujoco").at(entry.name) : nullptr,
                    .truth = &run.contact});
    const auto beliefs = [&](const noise::SensorNoise& levels) {
      return predict(*estimator, run, noise, levels)[1].p_contact;
    };
    // The filters that estimate the noise must forget it, too.
    const std::vector<double> first = beliefs({});
    (void)beliefs({.knee_torque = 2.0, .wheel_torque = 1.0, .acceleration = 8.0});
    EXPECT_EQ(beliefs({}), first) << entry.name;
  }
}

TEST(FittedModel, IsNeverFittedToReservedSeeds) {
  RunSignals reserved = synthetic_run(first_fit_run);
  reserved.info.seed = first_reserved_seed;
  for (const std::string& name : fitted_estimators()) {
    EXPECT_THAT(complaint_of([&] { fit_models(synthetic_experiment({name}), {&reserved}); }),
                ::testing::HasSubstr("reserved"))
        << name;
    // A direct call of the entry's fit is refused, too.
    const EstimatorEntry& entry = any_estimator_entry(name);
    EXPECT_THROW(entry.fit(RunPointers{&reserved}, 0.0), InputError) << name;
  }
}

TEST(FittedModel, IsNotFittedToTheEndIfItsFitIsStopped) {
  const RunSignals run = synthetic_run(first_fit_run, 1500);
  EXPECT_THROW(fit_models(synthetic_experiment({"robust"}), {&run}, [] { return false; }), Stopped);
}

TEST(FittedModel, NamesItsEstimatorAndProvenance) {
  const FittedModels models =
      fit_models(synthetic_experiment({"robust"}), pointers_to({synthetic_run(first_fit_run)}));
  const Model& fitted = models.at("mujoco").at("robust");
  EXPECT_EQ(estimator_of(fitted), "robust");
  EXPECT_THAT(text_of_array(fitted.arrays.at("provenance"), "provenance"),
              ::testing::AllOf(::testing::HasSubstr("seed:run: 1:1000000\n"),
                               ::testing::HasSubstr("seconds: 3.700\n")));
}

TEST(FittedModel, IsSharedByEstimatorsWithTheSameFit) {
  const auto shares = [](const char* one, const char* other) {
    return share_model(estimator_entry(one), estimator_entry(other));
  };
  EXPECT_TRUE(shares("robust", "measurement_only"));
  EXPECT_FALSE(shares("robust", "paper"));
  EXPECT_FALSE(shares("free_fall", "free_fall"));
  EstimatorEntry variant = estimator_entry("robust");
  variant.name = "variant";
  EXPECT_TRUE(share_model(variant, estimator_entry("robust")));
  for (const std::string& one : fitted_estimators()) {
    for (const std::string& other : fitted_estimators()) {
      EXPECT_EQ(share_fit(one, other),
                share_model(any_estimator_entry(one), any_estimator_entry(other)))
          << one << " " << other;
    }
  }
}

}  // namespace
}  // namespace touchdown::experiments
