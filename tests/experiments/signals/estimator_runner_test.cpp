#include "experiments/signals/estimator_runner.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/free_fall.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/plan/condition.hpp"
#include "experiments/plan/request.hpp"
#include "tests/experiments/synthetic_runs.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

WholeRunEstimator whole_run_free_fall() {
  return [](std::span<const Signals> steps) {
    FreeFall estimator{FreeFallConfig{}};
    std::vector<Belief> beliefs;
    for (const Signals& signals : steps) beliefs.push_back(estimator.update(signals));
    return beliefs;
  };
}

EstimatorEntry external(const std::string& name) {
  return {.name = name,
          .title = "External",
          .summary = "Runs free fall on whole runs",
          .reason = "a test",
          .sensors = {.acceleration = true},
          .making = {
              .whole_run = [](const EstimatorSetup& /*setup*/) { return whole_run_free_fall(); }}};
}

TEST(EstimatorRunner, GivesTheSameBeliefsForWholeRunsAsStepByStep) {
  RunSignals run = synthetic_run(0);
  for (std::size_t k = 650; k < 700; ++k) {
    run.signals[k].time = std::numeric_limits<double>::quiet_NaN();  // no record of it
  }
  const NoiseRun noise = noise_run(run, {.seed = 5});
  const noise::SensorNoise levels{.acceleration = 4.0};
  EstimatorRunner by_step(std::make_unique<FreeFall>(FreeFallConfig{}));
  EstimatorRunner whole_run(whole_run_free_fall());
  EXPECT_EQ(decide(whole_run, run, noise, levels), decide(by_step, run, noise, levels));
  const scoring::Prediction expected = predict(by_step, run, noise, levels);
  const scoring::Prediction predicted = predict(whole_run, run, noise, levels);
  for (std::size_t view = 0; view < scoring::view_count; ++view) {
    EXPECT_EQ(predicted[view].p_contact, expected[view].p_contact);
    EXPECT_EQ(predicted[view].contact, expected[view].contact);
  }
  const auto& p = predicted[0].p_contact;
  EXPECT_THAT(std::vector<double>(p.begin() + 650, p.begin() + 700), Each(p[649]));
}

/// Encoder noise changes estimators that use joint states, and no others.
TEST(EncoderNoise, ChangesOnlyEstimatorsThatUseEncoders) {
  const RunSignals run = synthetic_run(3);
  const Experiment experiment = synthetic_experiment(estimator_names());
  const FittedModels models = fit_models(experiment, pointers_to({synthetic_run(first_fit_run)}));
  const NoiseRun noise = noise_run(run, noise_key(experiment, 0, 3));
  for (const std::string& name : estimator_names()) {
    const auto estimator = make_estimator(experiment, {"mujoco", "mujoco", name}, models, run);
    const auto exact = predict(*estimator, run, noise, {});
    const auto noisy =
        predict(*estimator, run, noise, {.joint_position = 0.3, .joint_velocity = 30.0});
    const bool changed = exact[0].p_contact != noisy[0].p_contact;
    const Sensors& sensors = estimator_entry(name).sensors;
    EXPECT_EQ(changed, sensors.joint_position || sensors.joint_velocity) << name;
  }
}

TEST(ExternalEstimators, AreEvaluatedLikeBuiltInOnes) {
  Experiment experiment = synthetic_experiment({"free_fall"});
  experiment.external_estimators = {external("python:test.External")};
  const RunSignals run = synthetic_run(0);
  const NoiseRun noise = noise_run(run, noise_key(experiment, 0, 0));
  const auto cells = noise::noise_cells(experiment.noise);
  const auto counts_of = [&](const std::string& name) {
    const Condition condition{"mujoco", "mujoco", name};
    return sweep_run({&condition, 1}, cells, run, noise, {}, experiment, [] { return true; });
  };
  EXPECT_EQ(counts_of("python:test.External"), counts_of("free_fall"));
  EXPECT_THROW(make_estimator(experiment, {"mujoco", "mujoco", "python:test.External"}, {}, run),
               InputError);
}

TEST(ExternalEstimators, BelongToTheExperimentsThatTheyArePassedTo) {
  const Experiment without;
  Experiment with;
  with.external_estimators = {external("python:test.External")};
  EXPECT_EQ(estimator_entry(with, "python:test.External").title, "External");
  EXPECT_EQ(&estimator_entry(with, "robust"), &estimator_entry("robust"));
  EXPECT_EQ(estimator_names(with).size(), estimator_names(without).size() + 1);
  EXPECT_EQ(estimator_names(without), estimator_names());
  EXPECT_THROW(estimator_entry(without, "python:test.External"), InputError);
  EXPECT_THROW(estimator_entry("python:test.External"), InputError);
}

constexpr const char* experiment_with_external =
    "name: external\nsimulators: [mujoco]\nestimators: [free_fall, python:test.External]\n"
    "fit: {scenarios: [scenarios/flat.yaml]}\ntest: {scenarios: [scenarios/flat.yaml]}\n"
    "video: {enabled: false}\n";

TEST(ExternalEstimators, AreRefusedWithoutPythonAndUnderATakenName) {
  const YamlDocument document = YamlDocument::parse(experiment_with_external, "external.yaml");
  EXPECT_THAT([&] { experiment_from_yaml(document); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("external.yaml:3:"),
                        HasSubstr("'python:test.External' is written in Python: run the "
                                  "experiment from there, by 'python3 -m touchdown run'"))));
  EXPECT_THAT(
      [&] {
        experiment_from_yaml(document, {external("python:test.External"), external("robust")});
      },
      ThrowsMessage<InputError>(HasSubstr("the name 'robust' is taken")));
}

TEST(ExternalEstimators, OfAnotherRevisionMakeAnotherRequest) {
  const auto id_of = [](const std::string& revision) {
    EstimatorEntry entry = external("python:test.External");
    entry.revision = revision;
    const YamlDocument document = YamlDocument::parse(experiment_with_external, "external.yaml");
    const Experiment experiment = experiment_from_yaml(document, {entry});
    // It reads back from its own text.
    EXPECT_EQ(
        to_yaml(experiment_from_yaml(YamlDocument::parse(to_yaml(experiment), "again"), {entry})),
        to_yaml(experiment));
    return request_of(experiment).id;
  };
  EXPECT_EQ(id_of("one"), id_of("one"));
  EXPECT_NE(id_of("one"), id_of("two"));
  EXPECT_NE(id_of("one"), id_of(""));
}

}  // namespace
}  // namespace touchdown::experiments
