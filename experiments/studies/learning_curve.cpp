#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "core/rows.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/evaluation/joint_bootstrap.hpp"
#include "experiments/figures/figure_spec.hpp"
#include "experiments/plan/training_data.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/scores.hpp"
#include "experiments/studies/registry.hpp"
#include "simulators/registry.hpp"

namespace touchdown::experiments {

namespace {

/// The name of the section, of the group of the study's test runs, of its table and of its figure.
constexpr const char* learning_curve_name = "learning_curve";

/// The section `learning_curve`: scores of every fitted estimator by the size of its training set
/// (docs/explanation/learning_curve.md).
struct LearningCurveConfig {
  /// Numbers of training segments, increasing; without `fit.segments`, of fitted runs. A set takes
  /// them from the scenes in turn.
  std::vector<int> sizes;
  int draws = 1;  ///< training sets of each size, with different runs
};

/// The number of training segments, or without them of fitted runs.
std::size_t training_pieces(const Experiment& experiment) {
  if (experiment.training_segments.empty()) {
    return experiment.fit.scenarios.size() * static_cast<std::size_t>(experiment.fit.runs);
  }
  std::size_t pieces = 0;
  for (const TrainingSegments& segments : experiment.training_segments) {
    pieces += static_cast<std::size_t>(segments.runs);
  }
  return pieces;
}

void describe(Fields& fields, LearningCurveConfig& config, const Experiment& experiment) {
  const std::size_t most = training_pieces(experiment);
  const std::vector<int>& sizes = config.sizes;
  fields.know("sizes");
  fields.know("draws");
  fields.finish();
  fields.require("sizes", config.sizes)
      .range("from 1, increasing")
      .doc(
          "Sizes of the training sets: numbers of segments of `fit.segments`, from its scenes in "
          "turn; without it, of fitted runs.");
  fields.check(!sizes.empty(), "sizes", "expected at least one number");
  const bool is_increasing = std::is_sorted(sizes.begin(), sizes.end(), std::less_equal<>());
  fields.check(sizes.empty() || (sizes.front() >= 1 && is_increasing), "sizes",
               "expected increasing numbers from 1 on");
  fields.check(sizes.empty() || static_cast<std::size_t>(sizes.back()) <= most, "sizes",
               fmt::format("expected at most the number of segments or fitted runs, {}", most));
  fields("draws", config.draws, 1, 1000)
      .doc("Training sets of each size; all but the first are drawn from all segments or runs.");
}

/// The segments are planned already if one of the estimators learns from them anyway.
void require_segments(const RunRequest& request, Plan& plan) {
  if (std::ranges::any_of(plan.runs, &PlannedRun::is_of_segments)) return;
  const std::vector<TrainingSegments>& entries = request.experiment.training_segments;
  for (std::size_t entry = 0; entry < entries.size(); ++entry) {
    plan_segment_runs(request, {}, entry, 0, entries[entry].runs, plan);
  }
}

std::string fit_of_size(int size) { return fmt::format("~set{}", size); }

/// One estimator, fitted to training sets of one size, in one engine and noise setting.
struct LearningCurveRow {
  std::string simulator;
  noise::NoiseCell noise;
  std::string estimator;
  int size = 0;           ///< segments or runs
  double labelled = 0.0;  ///< duration of the first set (s)
  /// The mean over scenes and training sets. Its interval covers the choice of scenes, and of one
  /// training set.
  Interval balanced_accuracy = {};
  scoring::Classification points = {};  ///< over all scenes and training sets
  int draws = 0;                        ///< training sets
  int runs = 0;                         ///< scored test runs
};

/// Adds what the test runs of one condition and cell contribute to its row. Returns whether there
/// are scored runs.
bool add_scores(const std::vector<CollectedCounts>& scenes, const Condition& first,
                std::size_t cell, const scoring::BootstrapConfig& bootstrap,
                LearningCurveRow& row) {
  std::vector<SceneValues> by_scene;
  for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
    const auto sets = points_by_fit(scenes[scene], first, cell);
    if (sets.empty() || sets.front().empty()) continue;
    by_scene.push_back({balanced_accuracy_of_fits(sets, scene, bootstrap)});
    for (const auto& set : sets) row.points += scoring::sum(set);
    row.draws = static_cast<int>(sets.size());
    row.runs += static_cast<int>(sets.front().size());
  }
  if (by_scene.empty()) return false;
  row.balanced_accuracy = interval_of(mean_over_scenes(by_scene, bootstrap), bootstrap.level);
  return true;
}

/// The duration of the first training set of every size, by engine and size (s).
std::map<std::pair<std::string, int>, double> labelled_seconds(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  const TrainingPieces pieces = training_pieces(evaluation.runs, experiment);
  std::map<std::pair<std::string, int>, double> seconds;
  for (const int size : experiment.studies.at<LearningCurveConfig>().sizes) {
    const auto set = training_set(pieces.runs, static_cast<std::size_t>(size));
    for (const RunSignals* run : set) {
      seconds[{run->info.simulator, size}] += used_seconds(*run, pieces.skip);
    }
  }
  return seconds;
}

/// Rows by engine, estimator, size, then noise. A condition without scored runs has no rows.
std::vector<LearningCurveRow> learning_curve_rows(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  const std::size_t group = evaluation.plan.group_called(learning_curve_name).value();
  const std::vector<CollectedCounts> scenes = counts_by_scene(evaluation, group);
  const auto seconds = labelled_seconds(evaluation);
  std::vector<LearningCurveRow> rows;
  for (const Condition& condition : evaluation.plan.groups[group].conditions) {
    if (condition.refit > 0) continue;
    const int size = static_cast<int>(evaluation.plan.training_sets.at(condition.fit));
    for (std::size_t cell = 0; cell < experiment.highlights.size(); ++cell) {
      LearningCurveRow row{condition.test_simulator, experiment.highlights[cell],
                           condition.estimator, size, seconds.at({condition.fit_simulator, size})};
      if (add_scores(scenes, condition, cell, experiment.intervals.bootstrap, row)) {
        rows.push_back(std::move(row));
      }
    }
  }
  return rows;
}

Columns<LearningCurveRow> learning_curve_columns() {
  using Row = LearningCurveRow;
  return Columns<Row>()
      .text("simulator", &Row::simulator)
      .part(&Row::noise, noise_columns())
      .text("estimator", &Row::estimator)
      .number("size", &Row::size)
      .text("labelled_s", [](const Row& row) { return fmt::format("{:.3f}", row.labelled); })
      .interval("balanced_accuracy", &Row::balanced_accuracy)
      .metric("success", [](const Row& row) { return row.points.success(); })
      .metric("no_contact_recall", [](const Row& row) { return row.points.no_contact_recall(); })
      .count("draws", &Row::draws)
      .runs("runs", &Row::runs);
}

/// For the terminal: a table for every engine and noise setting.
std::string learning_curve_text(const std::vector<LearningCurveRow>& rows,
                                const Experiment& experiment) {
  const LearningCurveConfig& config = experiment.studies.at<LearningCurveConfig>();
  std::string text = fmt::format(
      "Balanced accuracy by seconds of labelled data, mean over scenes and {} of each size ({}; "
      "{:g} % intervals over training sets and test runs)\n",
      plural(static_cast<std::size_t>(config.draws), "training set"), labels_text(experiment),
      100.0 * experiment.intervals.bootstrap.level);
  const auto engine_and_noise = [](const LearningCurveRow& row) {
    return std::pair(row.simulator, noise_text(row.noise));
  };
  for (const auto& [key, alike] : group_by(rows, engine_and_noise)) {
    TextTable table = pivot(
        alike,
        [&](const LearningCurveRow& row) { return estimator_title_in(experiment, row.estimator); },
        [](const LearningCurveRow& row) { return fmt::format("{:.1f} s", row.labelled); },
        [](const LearningCurveRow& row) { return with_interval(row.balanced_accuracy); });
    table.header.front() = fmt::format("{}, {}", key.first, key.second);
    text += fmt::format("\n{}", to_text(table));
  }
  return text;
}

/// Balanced accuracy of every estimator over the seconds of labelled data, a panel per engine and
/// noise setting.
FigureSpec learning_curve_figure(const Table& learning_curve, const Experiment& experiment) {
  FigureSpec spec{.name = learning_curve_name, .table = "learning_curve.csv"};
  spec.panels = combinations_in(
      learning_curve, {"simulator", "torque_noise_nm", "accelerometer_noise_mps2"},
      [](const auto& values) {
        return fmt::format("{}, {} N·m, {} m/s²", simulators::simulator_title(values[0]), values[1],
                           values[2]);
      });
  spec.series = groups_in(learning_curve, "estimator", titles_in(experiment));
  spec.colour_order = experiment.estimators;
  spec.x = {.column = "labelled_s", .title = "labelled data", .unit = "s", .scale = AxisScale::log};
  spec.measures = {axis_with_interval("balanced_accuracy", "balanced accuracy")};
  spec.title = "Accuracy against the amount of labelled data";
  spec.caption = fmt::format(
      "Balanced accuracy, mean over scenes and {} of each size, of estimators fitted to increasing "
      "amounts of labelled data ({}{}; {:g} % intervals over training sets and test runs). Test "
      "runs are the same for all sizes.",
      plural(static_cast<std::size_t>(experiment.studies.at<LearningCurveConfig>().draws),
             "training set"),
      labels_text(experiment), setup_caption(experiment),
      100.0 * experiment.intervals.bootstrap.level);
  spec.alt = "Balanced accuracy." + values_text(spec, learning_curve);
  return spec;
}

class LearningCurveStudy final : public SectionStudy<LearningCurveConfig> {
 public:
  std::optional<StudySection> section() const override {
    return optional_section<LearningCurveConfig>(
        learning_curve_name, "Scores of every fitted estimator by the size of its training set.");
  }

  void add_needs(const RunRequest& /*request*/, Needs& needs) const override {
    needs.setups += 1.0;  // the signals of the test runs are kept once more
  }

  /// Adds the experiment's own test runs once more, with conditions for every fitted estimator,
  /// size and draw, at the highlighted noise settings. No run is simulated twice. Errors:
  /// `InputError` if none of the experiment's estimators is fitted.
  void plan(const RunRequest& request, Plan& plan) const override {
    const Experiment& experiment = request.experiment;
    const LearningCurveConfig& config = experiment.studies.at<LearningCurveConfig>();
    RunGroup group{learning_curve_name, {}, {}, experiment.highlights};
    group.scores_transfer = true;
    for (const Condition& own : own_engine_conditions(experiment)) {
      if (!estimator_entry(experiment, own.estimator).fits()) continue;
      for (const int size : config.sizes) {
        Condition condition = own;
        condition.fit = fit_of_size(size);
        for (condition.refit = 0; condition.refit < config.draws; ++condition.refit) {
          group.conditions.push_back(condition);
        }
      }
    }
    if (group.conditions.empty()) {
      throw InputError(
          "learning_curve: expected an estimator that is fitted among the experiment's");
    }
    for (const int size : config.sizes) {
      plan.training_sets[fit_of_size(size)] = static_cast<std::size_t>(size);
      plan.refits[fit_of_size(size)] = config.draws - 1;
    }
    require_segments(request, plan);
    const std::size_t first = plan.runs.size();
    plan_runs(request, RunRole::test, {}, plan.groups.size(), plan);
    plan.groups.push_back(std::move(group));
    plan_tasks(experiment, first, plan);
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const Experiment& experiment = evaluation.request.experiment;
    const std::vector<LearningCurveRow> rows = learning_curve_rows(evaluation);
    const Table table = directory.write_table("learning_curve.csv", learning_curve_columns(), rows);
    return {
        {learning_curve_text(rows, experiment)}, {}, {learning_curve_figure(table, experiment)}};
  }
};

}  // namespace

std::unique_ptr<const Study> learning_curve_study() {
  return std::make_unique<const LearningCurveStudy>();
}

}  // namespace touchdown::experiments
