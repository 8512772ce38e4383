#include "experiments/studies/labels/tables.hpp"

#include "scoring/bootstrap.hpp"

namespace touchdown::experiments {

namespace {

constexpr const char* name = "labels";

std::vector<scoring::LabelConfig> definitions() {
  std::vector<scoring::LabelConfig> all;
  for (const double threshold : {0.1, 1.0, 5.0, 10.0}) {
    for (const double debounce : {0.0, 0.002, 0.005, 0.01}) all.push_back({threshold, debounce});
  }
  return all;
}

using Truth = std::array<scoring::ContactSequence, models::wheel_count>;

Truth truth_of(const RunSignals& run, const scoring::LabelConfig& labels) {
  const double period = 1e-6 * static_cast<double>(run.info.control_period_us);
  Truth truth;
  for (std::size_t w = 0; w < models::wheel_count; ++w) {
    truth[w] = scoring::contact_labels(run.normal_force[w], period, labels);
  }
  return truth;
}

}  // namespace

Measure label_measure() {
  return measure_of_predictions<scoring::Classification>(
      name, definitions().size(), [](const MeasuredPrediction& made) {
        std::vector<scoring::Classification> counts;
        const bool is_wanted =
            made.cell == 0 && made.run.seed == 0 && made.condition.is_fitted_in_domain();
        if (!is_wanted) return counts;
        const RunSignals& run = made.run.signals;
        for (const scoring::LabelConfig& labels : definitions()) {
          const Truth truth = truth_of(run, labels);
          scoring::Classification& sum = counts.emplace_back();
          for (std::size_t w = 0; w < models::wheel_count; ++w) {
            sum += scoring::classify(truth[w], made.prediction[w].contact, {0},
                                     run.info.control_period_us, made.run.scoring)
                       .front();
          }
        }
        return counts;
      });
}

std::vector<LabelRow> label_rows(const Evaluation& evaluation) {
  std::vector<LabelRow> rows;
  const Experiment& experiment = evaluation.request.experiment;
  const RunGroup& group = evaluation.plan.groups.front();
  for (const std::string& simulator : experiment.simulators) {
    const std::vector<Condition> conditions = tested_on(group.conditions, simulator);
    std::vector<std::vector<MeasuredScores<scoring::Classification>>> runs;
    for (const std::size_t run : evaluation.plan.runs_in(0)) {
      if (evaluation.plan.runs[run].simulator != simulator) continue;
      runs.push_back(
          measured<scoring::Classification>(name, run, evaluation.plan, evaluation.saved));
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
      .level("force_threshold_n", [](const Row& row) { return row.labels.force_threshold; })
      .level("debounce_s", [](const Row& row) { return row.labels.debounce; })
      .interval("success", &Row::success)
      .interval("no_contact_precision", &Row::no_contact_precision)
      .interval("no_contact_recall", &Row::no_contact_recall);
}

}  // namespace touchdown::experiments
