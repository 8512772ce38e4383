#include "scoring/labels.hpp"

#include "core/files.hpp"
#include "experiments/plan/request.hpp"
#include "experiments/results/text_tables.hpp"
#include "experiments/studies/registry.hpp"
#include "scoring/bootstrap.hpp"

namespace touchdown::experiments {

namespace {

/// The name of the measure and of its tables.
constexpr const char* labels_name = "labels";

/// Shares of the weight that are 0.1, 1, 5 and 10 N for Upkie, each with windows of 0, 5, 10 and
/// 20 ms.
std::vector<scoring::LabelConfig> definitions() {
  std::vector<scoring::LabelConfig> all;
  for (const double share : {0.0019, 0.019, 0.095, 0.19}) {
    for (const double window : {0.0, 0.005, 0.01, 0.02}) all.push_back({share, window});
  }
  return all;
}

/// Measures decisions against other definitions of contact. Estimators stay as fitted, only the
/// truth changes. It measures in-domain predictions at the first highlighted noise setting with the
/// first noise realisation; a score is of type `scoring::Classification`, both wheels added.
Measure label_measure() {
  return measure_of_predictions<scoring::Classification>(
      labels_name, [](const MeasuredPrediction& made) {
        std::vector<scoring::Classification> counts;
        const bool is_wanted =
            made.cell == 0 && made.run.seed == 0 && made.condition.is_fitted_in_domain();
        if (!is_wanted) return counts;
        const RunSignals& run = made.run.signals;
        const double period = run.period();
        for (const scoring::LabelConfig& labels : definitions()) {
          scoring::Classification& sum = counts.emplace_back();
          for (std::size_t w = 0; w < models::wheel_count; ++w) {
            const auto truth = scoring::contact_labels(run.normal_force[w], period,
                                                       scoring::robot_mass(run.info), labels);
            sum += scoring::classify(truth, made.prediction[w].contact, {0},
                                     run.info.control_period_us, made.run.scoring)
                       .front();
          }
        }
        return counts;
      });
}

/// Point-wise scores of one estimator in one engine by one definition, with intervals over runs.
struct LabelRow {
  std::string simulator;
  std::string estimator;
  scoring::LabelConfig labels;
  Interval success;
  Interval no_contact_precision;
  Interval no_contact_recall;
};

/// By engine, estimator, definition.
std::vector<LabelRow> label_rows(const Evaluation& evaluation) {
  std::vector<LabelRow> rows;
  const Experiment& experiment = evaluation.request.experiment;
  const RunGroup& group = evaluation.plan.groups.front();
  for (const std::string& simulator : experiment.simulators) {
    const std::vector<Condition> conditions = tested_on(group.conditions, simulator);
    std::vector<std::vector<MeasuredScores<scoring::Classification>>> runs;
    for (const std::size_t run : evaluation.plan.runs_in(0, simulator)) {
      runs.push_back(
          measured<scoring::Classification>(labels_name, run, evaluation.plan, evaluation.saved));
      if (runs.back().empty()) runs.pop_back();
    }
    for (std::size_t c = 0; !runs.empty() && c < runs.front().size(); ++c) {
      for (std::size_t d = 0; d < definitions().size(); ++d) {
        std::vector<scoring::Classification> samples;
        for (const auto& run : runs) samples.push_back(run[c].scores[d]);
        const std::vector<Interval> scores = scoring::bootstrap<scoring::Classification>(
            samples,
            {&scoring::Classification::success, &scoring::Classification::no_contact_precision,
             &scoring::Classification::no_contact_recall},
            experiment.intervals.bootstrap);
        rows.push_back({simulator, conditions[runs.front()[c].condition].estimator,
                        definitions()[d], scores[0], scores[1], scores[2]});
      }
    }
  }
  return rows;
}

Columns<LabelRow> label_columns() {
  using Row = LabelRow;
  return Columns<Row>()
      .text("simulator", &Row::simulator)
      .text("estimator", &Row::estimator)
      .level("label_share", [](const Row& row) { return row.labels.share; })
      .level("label_window_s", [](const Row& row) { return row.labels.window; })
      .interval("success", &Row::success)
      .interval("no_contact_precision", &Row::no_contact_precision)
      .interval("no_contact_recall", &Row::no_contact_recall);
}

class LabelStudy final : public Study {
 public:
  bool is_requested(const Experiment& experiment) const override { return experiment.paper_tables; }

  void plan(const RunRequest& /*request*/, Plan& plan) const override {
    add_measure(label_measure(), plan.groups.front());
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const Table table =
        directory.write_table("labels.csv", label_columns(), label_rows(evaluation));
    write_atomically(directory.own_file("tables", "labels.md"),
                     to_markdown({"Point-wise scores by the definition of contact" +
                                      setup_caption(evaluation.request.experiment) + ".",
                                  labels_name, texts_of(table)}));
    return {};
  }
};

}  // namespace

std::unique_ptr<const Study> labels_study() { return std::make_unique<const LabelStudy>(); }

}  // namespace touchdown::experiments
