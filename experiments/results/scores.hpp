#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/evaluation/scored.hpp"
#include "experiments/run_directory/directory.hpp"
#include "noise/sensor_noise.hpp"

namespace touchdown::experiments {

/// A point-wise metric, by the name of its column. `title` stands in sentences.
struct PointMetric {
  const char* name;
  const char* title;
  double (scoring::Classification::*of)() const;
};
inline constexpr std::array<PointMetric, 6> point_metrics = {{
    {"success", "success rate", &scoring::Classification::success},
    {"contact_precision", "precision of contact", &scoring::Classification::contact_precision},
    {"contact_recall", "recall of contact", &scoring::Classification::contact_recall},
    {"no_contact_precision", "precision of air", &scoring::Classification::no_contact_precision},
    {"no_contact_recall", "recall of air", &scoring::Classification::no_contact_recall},
    {"balanced_accuracy", "balanced accuracy", &scoring::Classification::balanced_accuracy},
}};

/// The metric that the experiment's heatmaps show.
const PointMetric& mapped_metric(const Experiment& experiment);

/// The scores of an experiment as tables, of which terminal, report, figures and files are prints.
/// Intervals are over runs or drops.
struct ScoreTables {
  Table runs = {};   ///< by run
  Table cells = {};  ///< by condition and noise cell: `point_metrics`, and always contact's success
  Table scores = {};  ///< by highlighted cell, condition and view: `scoring::metrics`, and counts
  Table reliability = {};  ///< likewise, a row per bin of the calibration
  /// By highlighted cell, both wheels pooled, the shares of true events found up to a latency.
  Table latencies = {};
  /// By highlighted cell, the differences of each engine's first estimator from the others, a row
  /// per metric: both wheels pooled, the same runs or drops resampled.
  Table differences = {};
};

/// All but the runs. The experiment's own fits count, each tested on its engine.
ScoreTables score_tables(const ScoreRows& rows, const scoring::BootstrapConfig& bootstrap);

/// Writes `runs.csv`; `success.csv` and `classification.csv` (every noise cell); of the highlighted
/// ones `ranking.csv`, `views.csv` (per wheel, pooled, and for the robot), `transitions.csv`,
/// `latency.csv` (over detected events), `calibration.csv`, `reliability.csv`, `latencies.csv`
/// and `differences.csv`.
void write_score_tables(const ScoreTables& tables, const RunDirectory& directory);

/// Reads them. Errors: `InputError` when one is missing, as in a run that is not finished.
ScoreTables read_score_tables(const std::filesystem::path& run_directory);

/// Whether a row is about this noise setting.
bool is_at(const TableRow& row, const noise::NoiseCell& cell);

/// Of a row of `cells`: whether "always contact" is at least as accurate; whether hardly any of the
/// flight is reported.
bool loses(const TableRow& cell);
bool is_silent(const TableRow& cell);

/// Of a row of `runs`: whether it counts in the scores.
bool is_scored(const TableRow& run);

}  // namespace touchdown::experiments
