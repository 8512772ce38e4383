// Estimators that a robot loads must equal those of experiments and `touchdown estimate`.

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/yaml.hpp"
#include "estimator/models/make_estimator.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/submissions/export.hpp"
#include "logs/model_file.hpp"
#include "tests/complaint.hpp"
#include "tests/experiments/synthetic_runs.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;

/// Estimators for robots.
std::vector<std::string> installed_estimators() {
  std::vector<std::string> names;
  for (const EstimatorEntry& entry : all_estimator_entries()) {
    if (entry.fits() && !entry.is_upper_bound) names.push_back(entry.name);
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

TEST(LoadedEstimator, OfTheShippedModelEqualsItsEntry) {
  const std::filesystem::path file =
      std::filesystem::path(TOUCHDOWN_SOURCE_DIR) / "models/evidence_curves.npz";
  const RunSignals run = synthetic_run(3, 1000);
  const EstimatorEntry& entry = estimator_entry("shipped");
  EXPECT_EQ(p_contact_of(*load_estimator(file), run), p_contact_of(*entry.make({}), run));
  EXPECT_EQ(load_metadata(file).estimator, "evidence_curves");
  EXPECT_EQ(load_metadata(file).robot, "upkie");
}

TEST(ShippedModel, RefusesAnotherRobotOrRateInExperimentsAsItsFileDoes) {
  const EstimatorEntry& entry = estimator_entry("shipped");
  const auto complaint = [&](const EstimatorSetup& setup) {
    return complaint_of([&] { (void)entry.make(setup); });
  };
  LegGeometry long_legs;
  long_legs.upper_length *= 1.5;
  LegGeometry heavy;
  heavy.robot_mass *= 1.3;
  for (const LegGeometry& legs : {long_legs, heavy}) {
    EXPECT_THAT(complaint({.legs = legs, .robot = "other"}),
                HasSubstr("was fitted to the robot 'upkie', not to 'other'"));
  }
  LegGeometry with_rotors;
  with_rotors.wheel_inertia *= 1.2;
  EXPECT_EQ(complaint({.legs = with_rotors, .robot = "upkie_actuated"}), "no complaint");
  EXPECT_EQ(complaint({.legs = LegGeometry{}, .robot = "upkie"}), "no complaint");
  for (const double rate : {199.0, 200.0, 250.0, 400.0, 600.0, 1000.0, 1005.0}) {
    EXPECT_EQ(complaint({.sample_rate = rate}), "no complaint") << rate;
    const auto file = std::filesystem::path(TOUCHDOWN_SOURCE_DIR) / "models/evidence_curves.npz";
    EXPECT_NO_THROW((void)load_estimator(file, {.sample_rate = rate})) << rate;
  }
  for (const double rate : {100.0, 190.0, 1100.0, 2000.0}) {
    EXPECT_THAT(complaint({.sample_rate = rate}), HasSubstr("serves 200 to 1000 Hz")) << rate;
    const auto file = std::filesystem::path(TOUCHDOWN_SOURCE_DIR) / "models/evidence_curves.npz";
    EXPECT_THROW((void)load_estimator(file, {.sample_rate = rate}), InputError) << rate;
  }
}

TEST(ShippedModel, HasTheChecksumInItsManifest) {
  const std::filesystem::path models = std::filesystem::path(TOUCHDOWN_SOURCE_DIR) / "models";
  const YAML::Node manifest = YamlDocument::load(models / "evidence_curves.json").root();
  EXPECT_EQ(manifest["sha256"].as<std::string>(),
            sha256(read_file(models / "evidence_curves.npz")));
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
