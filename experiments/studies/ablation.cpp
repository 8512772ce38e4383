#include "estimator/bayes/ablation.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/rows.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/evaluation/joint_bootstrap.hpp"
#include "experiments/figures/figure_spec.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/scores.hpp"
#include "experiments/studies/registry.hpp"

namespace touchdown::experiments {

namespace {

/// The section `ablation`: each estimator of a row is compared with the one before it. The row is a
/// part of the experiment's estimators, which may then name those of `ablation_estimators`.
struct AblationConfig {
  std::string from;  ///< the first of the row
  std::string to;    ///< the last of the row
};

/// The estimators of the row. Errors: none for a configuration that was read.
std::vector<std::string> steps_of(const AblationConfig& config,
                                  const std::vector<std::string>& estimators) {
  const auto first = std::find(estimators.begin(), estimators.end(), config.from);
  const auto last = std::find(first, estimators.end(), config.to);
  if (last == estimators.end()) return {};
  return {first, last + 1};
}

void describe(Fields& fields, AblationConfig& config, const Experiment& experiment) {
  const std::vector<std::string>& estimators = experiment.estimators;
  constexpr const char* one_of_them = "one of the experiment's estimators";
  if (fields.reading()) config = {estimators.front(), estimators.back()};
  fields.choose("from", estimators, config.from)
      .type(one_of_them)
      .fallback("the first one")
      .doc("First estimator of the row.");
  fields.choose("to", estimators, config.to)
      .type(one_of_them)
      .fallback("the last one")
      .doc("Last estimator of the row.");
  fields.finish();
  fields.check(steps_of(config, estimators).size() >= 2, "to",
               "expected an estimator after the first one of the row");
}

/// The estimators that only this study has: the configurations between `paper` and `robust`
/// (estimator/bayes/ablation.hpp). Each differs from its neighbours by
/// one change; none is meant for a robot.
std::vector<EstimatorEntry> ablation_estimators() {
  std::vector<EstimatorEntry> entries;
  std::string before = "paper";
  for (const AblationStep& step : steps_from_paper_to_robust()) {
    entries.push_back(
        bayes_entry(step.name,
                    fmt::format("Runs `{}` with {}, an ablation step from paper to robust", before,
                                step.change),
                    "ablation of the paper's filter", step.config));
    entries.back().title = step.name;  // as tables name estimators outside the registry
    before = step.name;
  }
  return entries;
}

/// One estimator of the row in one noise setting: means over scenes and engines with equal weights.
struct AblationRow {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  noise::NoiseCell noise;
  std::string estimator;
  std::string before = {};             ///< the estimator before it; empty for the first one
  Resampled balanced_accuracy = {};    ///< over scenes and engines with scored runs
  Interval accuracy = {};              ///< the same with its interval
  Interval gain = {none, none, none};  ///< over that one, in the same resamples
  int runs = 0;                        ///< scored
};

/// The row of one estimator, without its gain.
AblationRow row_of(const std::vector<CollectedCounts>& scenes, const std::string& estimator,
                   std::size_t cell, const Experiment& experiment) {
  const scoring::BootstrapConfig& bootstrap = experiment.intervals.bootstrap;
  AblationRow row{experiment.highlights[cell], estimator};
  std::vector<SceneValues> by_scene;
  for (std::size_t scene = 0; scene < scenes.size(); ++scene) {
    SceneValues of_engines;
    for (const std::string& simulator : experiment.simulators) {
      const CountsByFit scores =
          points_by_fit(scenes[scene], {simulator, simulator, estimator}, cell);
      if (scores.empty() || scores.front().empty()) continue;
      of_engines.push_back(
          balanced_accuracy(scores, stream_of(scene, simulator, experiment), bootstrap));
      row.runs += static_cast<int>(scores.front().size());
    }
    if (!of_engines.empty()) by_scene.push_back(std::move(of_engines));
  }
  row.balanced_accuracy = mean_over_scenes(by_scene, bootstrap);
  row.accuracy = interval_of(row.balanced_accuracy, bootstrap.level);
  return row;
}

/// Rows by noise, then step. Refits of a benchmark widen the intervals, as in its standings.
std::vector<AblationRow> ablation_rows(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  const std::vector<CollectedCounts> scenes = counts_by_scene(evaluation, 0);
  const std::vector<std::string> steps =
      steps_of(experiment.studies.at<AblationConfig>(), experiment.estimators);
  std::vector<AblationRow> rows;
  for (std::size_t cell = 0; cell < experiment.highlights.size(); ++cell) {
    for (const std::string& estimator : steps) {
      AblationRow row = row_of(scenes, estimator, cell, experiment);
      if (estimator != steps.front()) {
        row.before = rows.back().estimator;
        row.gain = interval_of(row.balanced_accuracy - rows.back().balanced_accuracy,
                               experiment.intervals.bootstrap.level);
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

Columns<AblationRow> ablation_columns() {
  using Row = AblationRow;
  return Columns<Row>()
      .part(&Row::noise, noise_columns())
      .text("estimator", &Row::estimator)
      .text("before", &Row::before)
      .interval("balanced_accuracy", &Row::accuracy)
      .interval("gain", &Row::gain)
      .runs("runs", &Row::runs);
}

/// Balanced accuracy and gain of every step, for the terminal.
std::string ablation_text(const std::vector<AblationRow>& rows, const Experiment& experiment) {
  std::string text = fmt::format(
      "Balanced accuracy of every step and its gain over the step before, mean over scenes and "
      "engines ({}; {})\n",
      labels_text(experiment), intervals_text(experiment));
  for (const auto& [noise, alike] : group_by(rows, &AblationRow::noise)) {
    TextTable table{{noise_text(noise), "balanced accuracy", "gain"}, {}};
    for (const AblationRow& row : alike) {
      table.rows.push_back({estimator_title_in(experiment, row.estimator),
                            with_interval(row.accuracy), with_interval(row.gain)});
    }
    text += fmt::format("\n{}", to_text(table));
  }
  return text;
}

/// The gain of every step over the step before, a panel per noise setting.
FigureSpec ablation_figure(const Table& ablation, const Experiment& experiment) {
  FigureSpec spec{.name = "ablation", .table = "ablation.csv"};
  spec.panels = noise_panels(ablation);
  const std::vector<std::string> steps =
      steps_of(experiment.studies.at<AblationConfig>(), experiment.estimators);
  spec.rows.columns = {"estimator"};
  for (std::size_t step = 1; step < steps.size(); ++step) {
    spec.rows.groups.push_back({{steps[step]}, estimator_title_in(experiment, steps[step])});
  }
  spec.measures = {axis_with_interval("gain", "gain of balanced accuracy")};
  spec.title = "Gain of every step";
  spec.caption = fmt::format(
      "Balanced accuracy of every estimator minus that of the one above it, the first one's minus "
      "that of {}, in the same runs; mean over scenes and engines ({}{}; {}).",
      estimator_title_in(experiment, steps.front()), labels_text(experiment),
      setup_caption(experiment), intervals_text(experiment));
  spec.alt = "Gain of every step." + values_text(spec, ablation);
  return spec;
}

class AblationStudy final : public SectionStudy<AblationConfig> {
 public:
  std::optional<StudySection> section() const override {
    StudySection section = optional_section<AblationConfig>(
        "ablation", "Each of a row of estimators is compared with the one before it.");
    section.estimators = ablation_estimators;
    return section;
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const Experiment& experiment = evaluation.request.experiment;
    const std::vector<AblationRow> rows = ablation_rows(evaluation);
    const Table table = directory.write_table("ablation.csv", ablation_columns(), rows);
    return {{ablation_text(rows, experiment)}, {}, {ablation_figure(table, experiment)}};
  }
};

}  // namespace

std::unique_ptr<const Study> ablation_study() { return std::make_unique<const AblationStudy>(); }

}  // namespace touchdown::experiments
