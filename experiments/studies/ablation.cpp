#include "estimator/bayes/ablation.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

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

/// Balanced accuracy of every step, and its gain over the step before in the same resamples, by
/// noise, then step: means over scenes and engines with equal weights. Refits of a benchmark widen
/// the intervals, as in its standings.
Table ablation_table(const Evaluation& evaluation) {
  struct Row {
    const noise::NoiseCell* noise;
    std::string estimator;
    std::string before = {};  ///< the estimator before it; empty for the first one
    Interval accuracy = {};
    Interval gain = {NAN, NAN, NAN};
    std::int64_t runs = 0;  ///< scored
  };
  const Experiment& experiment = evaluation.request.experiment;
  const scoring::BootstrapConfig& bootstrap = experiment.intervals.bootstrap;
  const std::vector<std::string> steps =
      steps_of(experiment.studies.at<AblationConfig>(), experiment.estimators);
  std::vector<Row> rows;
  for (const noise::NoiseCell& cell : evaluation.plan.groups.front().scored) {
    Resampled before;
    for (const std::string& step : steps) {
      Row row{&cell, step};
      EstimatorRows own;
      for (const auto& scored : evaluation.own.scored) {
        const Condition& condition = *scored.condition;
        const bool is_own = scored.run != nullptr && scored.noise == &cell &&
                            condition.estimator == step && condition.is_in_domain("");
        if (!is_own) continue;
        own.push_back(&scored);
        row.runs += condition.refit == 0 ? 1 : 0;
      }
      Resampled accuracy = mean_over_scenes(balanced_accuracies(own, experiment), bootstrap);
      row.accuracy = interval_of(accuracy, bootstrap.level);
      if (step != steps.front()) {
        row.before = rows.back().estimator;
        row.gain = interval_of(accuracy - before, bootstrap.level);
      }
      before = std::move(accuracy);
      rows.push_back(std::move(row));
    }
  }
  return Columns<Row>()
      .part([](const Row& row) { return *row.noise; }, noise_columns())
      .text("estimator", &Row::estimator)
      .text("before", &Row::before)
      .interval("balanced_accuracy", &Row::accuracy)
      .interval("gain", &Row::gain)
      .runs("runs", &Row::runs)
      .table(rows);
}

/// Balanced accuracy and gain of every step, for the terminal.
std::string ablation_text(const Table& ablation, const Experiment& experiment) {
  std::string text = fmt::format(
      "Balanced accuracy of every step and its gain over the step before, mean over scenes and "
      "engines ({}; {})\n",
      labels_text(experiment), intervals_text(experiment));
  for (const noise::NoiseCell& cell : experiment.highlights) {
    TextTable table{{noise_text(cell), "balanced accuracy", "gain"}, {}};
    for (const TableRow& row : ablation.all()) {
      if (!is_at(row, cell)) continue;
      table.rows.push_back({estimator_title_in(experiment, row.text("estimator")),
                            with_interval(row.interval("balanced_accuracy")),
                            with_interval(row.interval("gain"))});
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
    const Table& table = directory.write_measured("ablation.csv", ablation_table(evaluation));
    return {{ablation_text(table, experiment)}, {}, {ablation_figure(table, experiment)}};
  }
};

}  // namespace

std::unique_ptr<const Study> ablation_study() { return std::make_unique<const AblationStudy>(); }

}  // namespace touchdown::experiments
