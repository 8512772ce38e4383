#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/rows.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "experiments/estimators/baselines.hpp"
#include "experiments/evaluation/joint_bootstrap.hpp"
#include "experiments/figures/figure_spec.hpp"
#include "experiments/results/captions.hpp"
#include "experiments/results/scores.hpp"
#include "experiments/studies/registry.hpp"
#include "scoring/operating_point.hpp"

namespace touchdown::experiments {

namespace {

/// The name of the section, of the measure, and of the figure.
constexpr const char* operating_points_name = "operating_points";

/// The section `operating_points`: scores of every estimator with these thresholds instead of its
/// own. Each `leave_below` is paired with each `return_above` that is not lower, and with none and
/// each `settle_at` (docs/reference/metrics.md).
struct OperatingPointsConfig {
  std::vector<double> leave_below = {0.02, 0.05, 0.1, 0.15, 0.25, 0.4, 0.5, 0.6, 0.75, 0.85, 0.95};
  std::vector<double> return_above = {0.25, 0.5, 0.75, 0.9, 0.98};
  std::vector<double> settle_at = {};  ///< for 20 ms
};

void describe(Fields& fields, OperatingPointsConfig& config, const Experiment& /*experiment*/) {
  const auto describe_thresholds = [&](const char* key, std::vector<double>& thresholds) {
    const KeyNotes notes = fields.in_line(key, thresholds);
    fields.check(!thresholds.empty() || &thresholds == &config.settle_at, key,
                 "expected at least one probability");
    fields.check(thresholds.empty() ||
                     (thresholds.front() > 0.0 && thresholds.back() < 1.0 &&
                      std::is_sorted(thresholds.begin(), thresholds.end(), std::less_equal<>())),
                 key, "expected increasing probabilities, none of them 0 or 1");
    return notes.range("between 0 and 1, increasing");
  };
  describe_thresholds("leave_below", config.leave_below)
      .doc("Thresholds of P(contact) below which contact ends.");
  describe_thresholds("return_above", config.return_above)
      .doc("Thresholds of P(contact) above which contact begins.");
  fields.check(config.leave_below.front() <= config.return_above.back(), "return_above",
               "expected a threshold of at least the lowest leave_below");
  describe_thresholds("settle_at", config.settle_at)
      .doc("P(contact) beyond one of these for 20 ms changes a decision, too.");
}

std::vector<OperatingPoint> points_of(const OperatingPointsConfig& config) {
  std::vector<OperatingPoint> points;
  for (const double leave_below : config.leave_below) {
    for (const double return_above : config.return_above) {
      if (leave_below > return_above) continue;
      points.push_back({leave_below, return_above, 0.0, 0.0});
      for (const double at : config.settle_at) {
        points.push_back({leave_below, return_above, at, 0.02});
      }
    }
  }
  return points;
}

/// Measures the own decisions of every condition that is fitted in domain, then its decisions at
/// each pair of thresholds: scores of type `scoring::OperatingScore`, over the whole run.
Measure operating_points_measure(const OperatingPointsConfig& config) {
  using Scores = std::vector<scoring::OperatingScore>;
  std::vector<OperatingPoint> points = points_of(config);
  const std::size_t most = 1 + points.size();
  return measure_of_predictions<scoring::OperatingScore>(
      operating_points_name, most, [points = std::move(points)](const MeasuredPrediction& made) {
        Scores scores;
        if (!made.condition.is_fitted_in_domain()) return scores;
        const RunSignals& run = made.run.signals;
        const scoring::Prediction& prediction = made.prediction;
        const auto add = [&](const std::array<scoring::ContactSequence, 2>& decided) {
          scores.push_back(scoring::operating_score(run.contact, decided,
                                                    run.info.control_period_us, made.run.scoring));
        };
        add({prediction[0].contact, prediction[1].contact});
        const double period = 1e-6 * static_cast<double>(run.info.control_period_us);
        for (const OperatingPoint& point : points) {
          add({scoring::decisions(prediction[0].p_contact, period, point),
               scoring::decisions(prediction[1].p_contact, period, point)});
        }
        return scores;
      });
}

/// One estimator in one scene, engine and noise setting, with these decision thresholds.
struct OperatingRow {
  std::string simulator;
  std::string scene;
  noise::NoiseCell noise;
  std::string estimator;
  std::optional<OperatingPoint> thresholds = {};  ///< empty: its own decision
  scoring::OperatingScore score = {};             ///< of all runs, both wheels added
};

/// The mean over all scenes and engines, with equal weights.
struct OperatingMean {
  noise::NoiseCell noise;
  std::string estimator;
  std::optional<OperatingPoint> thresholds = {};
  double balanced_accuracy = 0.0;
  double extra_switches_per_minute = 0.0;
  double false_takeoffs_per_minute = 0.0;
  double takeoff_error = 0.0;              ///< s; over scenes with detected takeoffs
  double extra_switches_per_flight = 0.0;  ///< total switches over total flights
  /// Whether no other thresholds dominate in balanced accuracy and extra switches (Pareto front).
  bool is_on_front = false;
};

/// Scores of an estimator's own decisions, then of its decisions at each pair of thresholds.
using PointScores = std::vector<scoring::OperatingScore>;

/// The scores of a scene in one engine, by condition and cell; empty without scored runs.
std::map<std::pair<std::uint32_t, std::uint32_t>, PointScores> point_scores(
    const Evaluation& evaluation, std::size_t scene, const std::string& simulator) {
  const Plan& plan = evaluation.plan;
  std::map<std::pair<std::uint32_t, std::uint32_t>, PointScores> sums;
  for (const std::size_t run :
       runs_in_scene(plan, evaluation.request.experiment, 0, scene, simulator)) {
    for (const auto& found :
         measured<scoring::OperatingScore>(operating_points_name, run, plan, evaluation.saved)) {
      PointScores& sum = sums[{found.condition, found.cell}];
      sum.resize(found.scores.size());
      for (std::size_t i = 0; i < found.scores.size(); ++i) sum[i] += found.scores[i];
    }
  }
  return sums;
}

/// Rows of the experiment's own test runs, by scene, engine, estimator, noise, then thresholds: the
/// estimator's own decision first. A scene without scored runs has no rows. "Always contact" is
/// left out: no threshold changes its decisions.
std::vector<OperatingRow> operating_rows(const Evaluation& evaluation) {
  const Experiment& experiment = evaluation.request.experiment;
  const RunGroup& group = evaluation.plan.groups.front();
  const std::vector<OperatingPoint> points =
      points_of(experiment.studies.at<OperatingPointsConfig>());
  std::vector<OperatingRow> rows;
  for (std::size_t scene = 0; scene < experiment.test.scenarios.size(); ++scene) {
    const std::string& file = experiment.test.scenarios[scene];
    for (const std::string& simulator : experiment.simulators) {
      const std::vector<Condition> conditions = tested_on(group.conditions, simulator);
      for (const auto& [place, scores] : point_scores(evaluation, scene, simulator)) {
        OperatingRow row{simulator, scenario_of(evaluation.request, file).scenario.name,
                         group.scored[place.second], conditions[place.first].estimator};
        if (row.estimator == always_contact_name) continue;
        for (std::size_t i = 0; i < scores.size(); ++i) {
          if (i > 0) row.thresholds = points[i - 1];
          row.score = scores[i];
          rows.push_back(row);
        }
      }
    }
  }
  return rows;
}

/// The mean of a score over the rows that define it; NaN without any.
template <typename ScoreOf>
double mean_of_defined(const std::vector<OperatingRow>& rows, const ScoreOf& score_of) {
  double sum = 0.0;
  double count = 0.0;
  for (const OperatingRow& row : rows) {
    const double value = std::invoke(score_of, row.score);
    if (std::isnan(value)) continue;
    sum += value;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

/// The mean over the rows of one estimator in one noise setting.
OperatingMean mean_of(const std::vector<OperatingRow>& rows) {
  using Score = scoring::OperatingScore;
  Score all;
  for (const OperatingRow& row : rows) all += row.score;
  return {rows.front().noise,
          rows.front().estimator,
          rows.front().thresholds,
          mean_of_defined(rows, &Score::balanced_accuracy),
          mean_of_defined(rows, &Score::extra_switches_per_minute),
          mean_of_defined(rows, &Score::false_takeoffs_per_minute),
          mean_of_defined(rows, &Score::takeoff_error),
          all.extra_switches_per_flight()};
}

/// Whether one point of an estimator in a noise setting is better than another of its points.
bool dominates(const OperatingMean& one, const OperatingMean& other) {
  if (one.estimator != other.estimator || !(one.noise == other.noise)) return false;
  const bool is_no_worse = one.balanced_accuracy >= other.balanced_accuracy &&
                           one.extra_switches_per_minute <= other.extra_switches_per_minute;
  return is_no_worse && (one.balanced_accuracy > other.balanced_accuracy ||
                         one.extra_switches_per_minute < other.extra_switches_per_minute);
}

/// Means by noise, estimator, then thresholds: the own decision first, which is on no front.
std::vector<OperatingMean> operating_means(const std::vector<OperatingRow>& rows) {
  const auto point_of = [](const OperatingRow& row) {
    return std::tuple(row.estimator, row.noise, row.thresholds);
  };
  std::vector<OperatingMean> means;
  for (const auto& alike : group_by(rows, point_of)) means.push_back(mean_of(alike.rows));
  std::stable_sort(means.begin(), means.end(), [](const auto& one, const auto& other) {
    return std::pair(one.noise.torque, one.noise.accelerometer) <
           std::pair(other.noise.torque, other.noise.accelerometer);
  });
  for (OperatingMean& mean : means) {
    if (!mean.thresholds) continue;
    mean.is_on_front = std::none_of(means.begin(), means.end(), [&](const OperatingMean& other) {
      return other.thresholds && dominates(other, mean);
    });
  }
  return means;
}

/// A threshold as a cell; empty for an estimator's own decision.
template <typename Row>
auto threshold(double OperatingPoint::*one) {
  return [one](const Row& row) {
    return row.thresholds ? exact((*row.thresholds).*one) : std::string();
  };
}

template <typename Row>
Columns<Row> point_columns() {
  return Columns<Row>()
      .part(&Row::noise, noise_columns())
      .text("estimator", &Row::estimator)
      .text("leave_below", threshold<Row>(&OperatingPoint::leave_below))
      .text("return_above", threshold<Row>(&OperatingPoint::return_above))
      .text("settle_at", threshold<Row>(&OperatingPoint::settle_at));
}

Columns<OperatingRow> row_columns() {
  using Score = scoring::OperatingScore;
  return Columns<OperatingRow>()
      .text("simulator", &OperatingRow::simulator)
      .text("scenario", &OperatingRow::scene)
      .as("scene")
      .part(std::identity(), point_columns<OperatingRow>())
      .part(&OperatingRow::score,
            Columns<Score>()
                .metric("balanced_accuracy", &Score::balanced_accuracy)
                .metric("success", [](const Score& s) { return s.points.success(); })
                .metric("extra_switches_per_minute", &Score::extra_switches_per_minute)
                .metric("false_takeoffs_per_minute", &Score::false_takeoffs_per_minute)
                .metric("takeoff_recall", &Score::takeoff_recall)
                .metric("takeoff_error_ms", [](const Score& s) { return 1e3 * s.takeoff_error(); })
                .count("extra_switches", &Score::extra_switches)
                .count("flights", &Score::flights));
}

Columns<OperatingMean> mean_columns() {
  using Mean = OperatingMean;
  return point_columns<Mean>()
      .metric("balanced_accuracy", &Mean::balanced_accuracy)
      .metric("extra_switches_per_minute", &Mean::extra_switches_per_minute)
      .metric("false_takeoffs_per_minute", &Mean::false_takeoffs_per_minute)
      .metric("takeoff_error_ms", [](const Mean& mean) { return 1e3 * mean.takeoff_error; })
      .metric("extra_switches_per_flight", &Mean::extra_switches_per_flight)
      .flag("on_front", &Mean::is_on_front);
}

std::string switches_text(double per_minute) {
  return fmt::format("{:.{}f}", per_minute, per_minute < 10.0 ? 1 : 0);
}

constexpr std::array limits = {30.0, 10.0, 3.0, 1.0};  // on extra switches per minute

/// Balanced accuracy of an estimator's own decision, then of the best thresholds within each limit.
std::vector<std::string> short_row(const OperatingMean& own,
                                   const std::vector<OperatingMean>& means,
                                   const Experiment& experiment) {
  std::vector<std::string> cells = {estimator_title_in(experiment, own.estimator),
                                    fmt::format("{:.4f} ({})", own.balanced_accuracy,
                                                switches_text(own.extra_switches_per_minute))};
  for (const double limit : limits) {
    double best = -1.0;
    for (const OperatingMean& mean : means) {
      const bool counts = mean.is_on_front && mean.estimator == own.estimator &&
                          mean.noise == own.noise && mean.extra_switches_per_minute <= limit;
      if (counts) best = std::max(best, mean.balanced_accuracy);
    }
    cells.push_back(best < 0.0 ? "-" : fmt::format("{:.4f}", best));
  }
  return cells;
}

std::string operating_points_text(const std::vector<OperatingMean>& means,
                                  const Experiment& experiment) {
  std::string text = fmt::format(
      "Balanced accuracy, mean over scenes and engines, of the best thresholds of P(contact) by "
      "limit on extra switches per minute ({}); own decision: its extra switches per minute in "
      "brackets\n",
      labels_text(experiment));
  for (const noise::NoiseCell& cell : experiment.highlights) {
    TextTable table{{noise_text(cell), "own decision"}, {}};
    for (const double limit : limits) table.header.push_back(fmt::format("≤ {:.0f}", limit));
    for (const OperatingMean& mean : means) {
      if (!mean.thresholds && mean.noise == cell)
        table.rows.push_back(short_row(mean, means, experiment));
    }
    text += fmt::format("\n{}", to_text(table));
  }
  return text;
}

constexpr double fewest = 0.3;  // extra switches per minute: the axis begins here

/// Error and extra switches of each estimator's own decision.
std::string own_decisions_text(const FigureSpec& spec, const Table& table, const Experiment& of) {
  std::string text;
  for (std::size_t panel = 0; panel < spec.panels.groups.size(); ++panel) {
    text += fmt::format(" {}:", spec.panels.groups[panel].title);
    for (const TableRow& row : table.all()) {
      if (group_of(spec.panels, row) != panel || !row.text("leave_below").empty()) continue;
      text += fmt::format(" {} by its own decision {:.2f} % with {:.1f} per minute;",
                          estimator_title_in(of, row.text("estimator")),
                          drawn_value(spec.measures.front(), row), drawn_value(spec.x, row));
    }
    text.back() = '.';
  }
  return text;
}

/// Balanced error against extra switches: the Pareto front of every estimator over its thresholds,
/// and a ring for its own.
FigureSpec operating_points_figure(const Table& operating_points, const Experiment& experiment) {
  FigureSpec spec{.name = operating_points_name, .table = "operating_points.csv"};
  spec.panels = noise_panels(operating_points);
  spec.series = groups_in(operating_points, "estimator", titles_in(experiment));
  spec.colour_order = experiment.estimators;
  spec.x = {.column = "extra_switches_per_minute",
            .title = "extra switches per minute",
            .scale = AxisScale::log,
            .floor = fewest};
  spec.measures = {{.column = "balanced_accuracy",
                    .title = "1 − balanced accuracy",
                    .unit = "%",
                    .scale = AxisScale::log,
                    .factor = -100.0,
                    .offset = 100.0}};
  spec.marks = {{MarkShape::curve, {{"on_front", "1"}}}, {MarkShape::ring, {{"leave_below", ""}}}};
  spec.title = "Balanced error against extra switches";
  spec.caption = fmt::format(
      "1 − balanced accuracy against extra switches of the decision, both averaged over scenes and "
      "engines ({}). Each curve is the Pareto front of one estimator over decision thresholds on "
      "its P(contact); a ring marks its own thresholds. Values below {} extra switches per minute "
      "are drawn at that value.",
      labels_text(experiment), fewest);
  spec.alt = "Error against switches." + own_decisions_text(spec, operating_points, experiment);
  return spec;
}

class OperatingPointsStudy final : public SectionStudy<OperatingPointsConfig> {
 public:
  std::optional<StudySection> section() const override {
    return optional_section<OperatingPointsConfig>(
        operating_points_name, "Scores of every estimator with other thresholds.");
  }

  void plan(const RunRequest& request, Plan& plan) const override {
    add_measure(operating_points_measure(section_of(request.experiment)), plan.groups.front());
  }

  StudyResult summarize(const Evaluation& evaluation,
                        const RunDirectory& directory) const override {
    const Experiment& experiment = evaluation.request.experiment;
    const std::vector<OperatingRow> rows = operating_rows(evaluation);
    const std::vector<OperatingMean> means = operating_means(rows);
    directory.write_table("operating_points_by_scene.csv", row_columns(), rows);
    const Table table = directory.write_table("operating_points.csv", mean_columns(), means);
    return {{operating_points_text(means, experiment)},
            {},
            {operating_points_figure(table, experiment)}};
  }
};

}  // namespace

std::unique_ptr<const Study> operating_points_study() {
  return std::make_unique<const OperatingPointsStudy>();
}

}  // namespace touchdown::experiments
