// Estimators that a robot loads must equal those of experiments and `touchdown estimate`.

#include <algorithm>

#include <gtest/gtest.h>

#include "estimator/models/make_estimator.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/submissions/export.hpp"
#include "logs/model_file.hpp"
#include "tests/experiments/synthetic_runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

/// Estimators for robots.
std::vector<std::string> installed_estimators() {
  std::vector<std::string> names;
  for (const EstimatorEntry& entry : all_estimator_entries()) {
    if (entry.fits()) names.push_back(entry.name);
  }
  return names;
}

std::array<std::vector<double>, 2> p_contact_of(ContactEstimator& estimator,
                                                const RunSignals& run) {
  const scoring::Prediction prediction = predict(estimator, run, noise_run(run, {}), {});
  return {prediction[0].p_contact, prediction[1].p_contact};
}

TEST(LoadedEstimator, EqualsItsEntryToTheBit) {
  const ScratchFolder folder;
  const RunSignals run = synthetic_run(3, 2000);
  const FittedModels models = fit_models(synthetic_experiment(installed_estimators()),
                                         pointers_to({synthetic_run(first_fit_run)}));
  for (const std::string& name : installed_estimators()) {
    const EstimatorEntry& entry = any_estimator_entry(name);
    const std::filesystem::path file = folder / (name + ".npz");
    logs::save_model(models.at("mujoco").at(name), file);
    const Model read = load_model(file);
    EXPECT_EQ(p_contact_of(*load_estimator(file), run),
              p_contact_of(*entry.make({.model = &read}), run))
        << name;
    EXPECT_EQ(load_metadata(file).estimator, name);
    EXPECT_EQ(load_metadata(file).sample_rate, 1000.0);
    EXPECT_EQ(read.metadata->fingerprint.size(), 16U);
  }
}

TEST(LoadedEstimator, OfAShippedNetworkIsNmn) {
  const RunSignals run = synthetic_run(3, 1000);
  for (const std::string name : {"nmn", "nmn_retrained"}) {
    const std::filesystem::path file =
        std::filesystem::path(TOUCHDOWN_SOURCE_DIR) / "models" / (name + ".npz");
    const EstimatorEntry& entry = any_estimator_entry(name);
    EXPECT_EQ(p_contact_of(*load_estimator(file, {.sample_rate = 1000.0}), run),
              p_contact_of(*entry.make({}), run))
        << name;
  }
}

TEST(LoadedEstimator, OfARobotsGeometryIsTheLoadFilterOfItsEntry) {
  const ScratchFolder folder;
  const RunSignals run = synthetic_run(3, 1000);
  LegGeometry legs;
  legs.upper_length *= 1.2;
  legs.robot_mass *= 1.3;
  logs::save_model(load_filter_model(legs, 1000.0, "mine"), folder / "m.npz");
  EXPECT_EQ(p_contact_of(*load_estimator(folder / "m.npz"), run),
            p_contact_of(*estimator_entry("load_filter").make({.legs = legs}), run));
}

TEST(LoadedEstimator, SharesFitsAsEntriesDo) {
  for (const std::string& one : installed_estimators()) {
    for (const std::string& other : installed_estimators()) {
      EXPECT_EQ(share_fit(one, other),
                share_model(any_estimator_entry(one), any_estimator_entry(other)))
          << one << " " << other;
    }
  }
}

}  // namespace
}  // namespace touchdown::experiments
