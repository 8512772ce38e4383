#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/interval.hpp"
#include "render/gnuplot/figure.hpp"
#include "render/report/study_pictures.hpp"
#include "render/report/subject.hpp"

namespace touchdown::render {

/// One row of a run directory's `benchmark.csv`: an in-domain score in one scene.
struct SceneScore {
  std::string simulator;
  std::string setting;  ///< "upkie, harsh sensors"
  std::string noise;    ///< "1 N·m, 5 m/s²"
  std::string scene;
  std::string estimator;
  bool is_unseen = false;  ///< no estimator was fitted to scenes like it
  Interval accuracy;
  double no_contact_precision = 0.0;
  double no_contact_recall = 0.0;
  double flight_f1 = 0.0;
  double extra_switches_per_minute = 0.0;
  double false_takeoffs_per_minute = 0.0;
  double takeoff_latency_median_ms = 0.0;
};

/// One row of `benchmark_standings.csv`.
struct Standing {
  std::string setting;
  std::string robot;
  std::string sensors;
  std::string noise;
  std::string estimator;
  Interval mean;
  double worst = 0.0;
  std::string worst_scene;
  std::string worst_simulator;
  bool is_not_significantly_worse = false;
  double excess_log_loss = 0.0;  ///< above the reference upper bound's (bits per wheel and step)
};

/// One row of `benchmark_differences.csv`. Without a scene, it is the difference of the means over
/// all scenes.
struct PairedBand {
  std::string setting;
  std::string noise;
  std::string scene;
  std::string first;
  std::string second;
  Interval difference;
};

/// A benchmark's results, read from its tables.
struct BenchmarkScores {
  std::vector<SceneScore> scenes;
  std::vector<Standing> standings;
  std::vector<PairedBand> pairs;
};

/// Empty where the run directory has no such tables. Errors: `InputError` for unreadable ones.
BenchmarkScores benchmark_scores(const std::filesystem::path& run_directory);

/// The path, without its extension, of the figure of one robot with its sensors.
std::filesystem::path standings_stem(const std::filesystem::path& run_directory,
                                     const Standing& standing);

/// Draws the ranking of the estimators on one robot with its sensors, a row of panels for every
/// noise setting. The left panel has means over all scenes and engines with their intervals, the
/// best above. Bars join estimators that do not differ significantly, as Demšar (2006) draws
/// critical differences; here the simultaneous bands of paired differences decide. The right panel
/// has the worst scene of each. `level` is the confidence level of the intervals. Files and errors
/// as `draw_figure`.
Figure draw_standings_figure(const BenchmarkScores& scores, const std::string& setting,
                             double level, const std::filesystem::path& stem);

/// Draws a figure for every robot with its sensors in the run directory's tables.
void draw_standings_figures(const std::filesystem::path& run_directory, double level);

/// Writes `benchmark.html` into the run directory of an experiment with a benchmark, from its
/// tables and figures: the ranking, robots × sensors, every scene, a card for each estimator.
/// Returns the page.
std::filesystem::path write_benchmark_page(const ReportSubject& subject);

/// The segment with the most wrong decisions of an estimator.
struct WorstSegment {
  std::size_t run = 0;     ///< index of the run
  std::size_t begin = 0;   ///< first step
  std::int64_t wrong = 0;  ///< wrong decisions about wheels in the segment
};

/// The first of the worst segments of `length` steps. `wrong` contains, for each run and step, the
/// number of wheels with a wrong decision. A shorter run counts as one segment.
WorstSegment worst_segment(const std::vector<std::vector<int>>& wrong, std::size_t length);

}  // namespace touchdown::render
