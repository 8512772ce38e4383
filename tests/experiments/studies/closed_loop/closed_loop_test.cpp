#include <map>
#include <string>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/tables/table.hpp"
#include "estimator/evidence/curves.hpp"
#include "estimator/models/parameters.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "experiments/run_directory/shard.hpp"
#include "experiments/run_experiment.hpp"
#include "experiments/studies/closed_loop/rollout.hpp"
#include "experiments/studies/experiment_file.hpp"
#include "tests/experiments/small_step_scene.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

Experiment with_closed_loop(const ScratchFolder& folder, const std::string& section,
                            const std::string& sensors = "sensors/upkie.yaml",
                            const std::string& estimators = "[support_force, robust]") {
  const std::string step = folder.write("small_step.yaml", small_step_scene).string();
  return experiment_from_yaml(
      YamlDocument::parse("name: small\nestimators: " + estimators + "\nsensors: " + sensors +
                              "\nfit: {scenarios: [" + step + "]}\ntest: {scenarios: [" + step +
                              "], runs: 1}\nrecordings: none\nvideo: {enabled: false}\n" + section,
                          "small.yaml"));
}

std::string of_steps(const ScratchFolder& folder, const std::string& scene) {
  return "closed_loop:\n  runs: 2\n  scenes: [{scenario: " + (folder / "small_step.yaml").string() +
         scene + "}]\n";
}

const char* const two_heights = ", key: terrain.pieces.1.step.drop, values: [0.1, 0.3]";

TEST(ClosedLoop, CountsFinishedRunsForEveryContactSourceAndPoint) {
  const ScratchFolder folder;
  RunOptions options;
  options.out = folder / "run";
  const ExperimentResult result =
      run_experiment(with_closed_loop(folder, of_steps(folder, two_heights)), options);
  const Table table = from_csv(read_file(folder / "run/tables/survival.csv"));
  ASSERT_GE(table.header.size(), 9U);
  EXPECT_THAT(std::vector<std::string>(table.header.begin(), table.header.begin() + 9),
              ElementsAre("simulator", "scenario", "policy", "contact", "rise_m", "runs",
                          "finished", "finished_low", "finished_high"));
  ASSERT_EQ(table.rows.size(), 2U * 4U * 2U);  // engines, contact sources, heights
  std::vector<std::string> contacts;
  for (const std::vector<std::string>& row : table.rows) {
    const auto number = [&](const char* column) { return std::stod(cell(table, row, column)); };
    if (contacts.size() < 4 && number("value") == 0.1)
      contacts.push_back(cell(table, row, "contact"));
    EXPECT_EQ(cell(table, row, "policy"), "soft_landing");
    EXPECT_EQ(cell(table, row, "is_oracle"), cell(table, row, "contact") == "truth" ? "1" : "0");
    EXPECT_EQ(number("finished"), 1.0) << "a drop of 0.3 m is no danger";
    EXPECT_NEAR(number("finished_low"), 0.1581, 1e-4);  // of two runs
    EXPECT_EQ(number("landings"), 4.0);
    EXPECT_GT(number("largest_force_n"), 100.0);
  }
  EXPECT_THAT(contacts, ElementsAre("truth", "always", "support_force", "robust"));
  EXPECT_THAT(result.studies.back(), AllOf(HasSubstr("Truth (oracle)"), HasSubstr("drop 0.3")));
  EXPECT_THAT(own_files(folder / "run"), Contains(std::filesystem::path("tables/survival.csv")));
  EXPECT_THAT(own_files(folder / "run"),
              Contains(std::filesystem::path("state/closed_loop/run_000000")));
}

TEST(ClosedLoop, IsTheSameInShardsAndWhenResumed) {
  const ScratchFolder folder;
  const Experiment experiment = with_closed_loop(folder, of_steps(folder, two_heights));
  RunOptions options;
  options.out = folder / "whole";
  run_experiment(experiment, options);
  const std::string table = read_file(folder / "whole/tables/survival.csv");
  const std::string results = read_file(folder / "whole/tables/results.csv");
  const std::string state = read_file(folder / "whole/state/closed_loop/run_000019");

  std::filesystem::remove(folder / "whole/state/closed_loop/run_000019");
  std::filesystem::remove(folder / "whole/tables/survival.csv");
  run_experiment(experiment, options);
  EXPECT_EQ(read_file(folder / "whole/tables/survival.csv"), table);
  EXPECT_EQ(read_file(folder / "whole/state/closed_loop/run_000019"), state);

  options.out = folder / "shards";
  run_shard(experiment, Shard{1, 2}, options);
  EXPECT_THAT([&] { merge_run(folder / "shards", options); },
              ThrowsMessage<InputError>(HasSubstr("finish shard 2/2 first")));
  run_shard(experiment, Shard{2, 2}, options);
  std::filesystem::remove(folder / "shards/state/closed_loop/run_000031");
  EXPECT_THAT([&] { merge_run(folder / "shards", options); },
              ThrowsMessage<InputError>(HasSubstr("finish shard 2/2 first")));
  run_shard(experiment, Shard{2, 2}, options);
  merge_run(folder / "shards", options);
  EXPECT_EQ(read_file(folder / "shards/tables/survival.csv"), table);
  EXPECT_EQ(read_file(folder / "shards/tables/results.csv"), results);
}

/// A model that decides by the load of the servos' laws alone.
FittedModel model_by_servo_load() {
  EvidenceModel model;
  model.servo_curve.assign(std::tuple_size_v<ServoLoadInputs>, EvidenceCurve{});
  model.servo_seen.resize(model.servo_curve.size());
  for (std::size_t k = 0; k < evidence_knots; ++k) {
    model.servo_curve[3][k] = 4.0F * (static_cast<float>(k) - 22.0F);  // 0 nats at 12 N
  }
  return {{.arrays = arrays_of(parameters_of(model), "evidence_curves")}};
}

TEST(ClosedLoop, ContactSourcesDecideAsInOfflineEvaluation) {
  // The reference: the recorded run, evaluated offline with the same sensors and noise.
  const ScratchFolder folder;
  const std::map<std::string, FittedModel> models = {{"support_force", {}},
                                                     {"evidence_curves", model_by_servo_load()}};
  for (const auto& [name, model] : models) {
    for (const char* sensors : {"sensors/upkie.yaml", "sensors/harsh.yaml", "sensors/ideal.yaml"}) {
      const RunRequest request = request_of(
          with_closed_loop(folder,
                           of_steps(folder, ", noise: [{torque: 0.3, accelerometer: 1.0}]") +
                               "  contact: [" + name + "]\n",
                           sensors, "[" + name + "]"));
      const Experiment& experiment = request.experiment;
      scenarios::CompiledScenes scenes;
      const ClosedLoopCell cell = closed_loop_cells(experiment).front();
      const FittedModels fitted = {{cell.simulator, {{name, model}}}};
      const ClosedLoopRun loop =
          run_closed_loop(request, cell, 1, fitted, scenes, [] { return true; });
      recordings::Recording reported = loop.recording;
      report_through_sensors(profile_of(request.sensors, experiment.sensors), experiment, 1,
                             reported);
      const RunSignals run =
          signals_of(reported, experiment.labels, experiment.scoring, experiment.intervals.over);
      const EstimatorEntry& entry = estimator_entry(name);
      const auto estimator = entry.make(entry, {.model = &model, .legs = run.legs});
      const auto offline = predict(*estimator, run, noise_run(run, noise_key(experiment, 0, 1)),
                                   cell.noise.levels());
      for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
        EXPECT_EQ(loop.trace.contact[wheel], offline[wheel].contact) << name << ", " << sensors;
      }
      EXPECT_THAT(loop.trace.contact[0], AllOf(Contains(0), Contains(1))) << name;
    }
  }
}

TEST(ClosedLoop, StartsAllRunsEquallyForEveryContactSource) {
  const ScratchFolder folder;
  const RunRequest request = request_of(with_closed_loop(folder, of_steps(folder, "")));
  scenarios::CompiledScenes scenes;
  std::vector<std::string> scripts;
  for (const ClosedLoopCell& cell : closed_loop_cells(request.experiment)) {
    if (cell.contact == "robust") continue;  // it needs a fit
    scenarios::Scenario rollout =
        run_closed_loop(request, cell, 1, {}, scenes, [] { return true; }).scenario;
    EXPECT_EQ(rollout.policy.contact, cell.contact);
    rollout.policy = {};
    scripts.push_back(scenarios::to_yaml(rollout));
  }
  ASSERT_GT(scripts.size(), 4U);
  EXPECT_THAT(scripts, ::testing::Each(scripts.front()));
}

TEST(ClosedLoop, ConfigurationReadsBackAsWritten) {
  const ScratchFolder folder;
  EXPECT_THAT(to_yaml(with_closed_loop(folder, "")), Not(HasSubstr("closed_loop")));
  const std::string text = to_yaml(with_closed_loop(
      folder,
      of_steps(folder, two_heights) +
          "  laws: [soft_landing, balancer]\n  contact: [truth, robust]\n  film: {point: 1}\n"));
  EXPECT_THAT(text, AllOf(HasSubstr("values"), HasSubstr("film")));
  EXPECT_EQ(text, to_yaml(experiment_from_yaml(YamlDocument::parse(text, "again.yaml"))));
}

TEST(ClosedLoop, ComplainsOnTheLine) {
  const ScratchFolder folder;
  const auto complaint = [&](const std::string& section) -> std::string {
    try {
      (void)request_of(with_closed_loop(folder, section));
      require_closed_loop(request_of(with_closed_loop(folder, section)));
    } catch (const InputError& error) {
      return error.what();
    }
    return "no complaint";
  };
  const auto of_scene = [&](const std::string& scene) {
    return complaint(of_steps(folder, scene));
  };
  EXPECT_EQ(of_scene(""), "no complaint");
  EXPECT_THAT(of_scene(", key: terrain.friction"),
              AllOf(HasSubstr("small.yaml:10:"), HasSubstr("values")));
  EXPECT_THAT(of_scene(", values: [1, 2]"), HasSubstr("key"));
  EXPECT_THAT(of_scene(", key: terrain.friction, values: [1, 0.5]"),
              HasSubstr("expected increasing numbers"));
  EXPECT_THAT(of_scene(", key: terrain.friction, values: [0.5, 1], delay: [0, 0.1]"),
              HasSubstr("at most one varied quantity"));
  EXPECT_THAT(of_scene(", delay: [-0.1]"), HasSubstr("from 0 to 1 s"));
  EXPECT_THAT(of_scene(", dela: [0.1]"), HasSubstr("did you mean"));
  EXPECT_THAT(of_scene(", key: terrain.frction, values: [1]"),
              AllOf(HasSubstr("closed_loop.scenes.0"), HasSubstr("no number there")));
  EXPECT_THAT(of_scene(", key: terrain.friction, values: [-1]"),
              AllOf(HasSubstr("closed_loop.scenes.0"), HasSubstr("terrain.friction")));
  const std::string scene = of_steps(folder, "");
  EXPECT_THAT(complaint(scene + "  contact: [robst]\n"), HasSubstr("did you mean 'robust'?"));
  EXPECT_THAT(complaint(scene + "  laws: [soft]\n"), HasSubstr("soft_landing"));
  EXPECT_THAT(complaint(scene + "  film: {run: 2}\n"), HasSubstr("film.run"));
  EXPECT_THAT(complaint(scene + "  film: {contact: [phase]}\n"), HasSubstr("film.contact"));
  EXPECT_THAT(complaint("closed_loop: {runs: 2}\n"), HasSubstr("scenes"));
}

}  // namespace
}  // namespace touchdown::experiments
