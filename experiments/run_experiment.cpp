#include "experiments/run_experiment.hpp"

#include <chrono>
#include <thread>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "experiments/estimator_registry.hpp"
#include "experiments/fingerprint.hpp"
#include "experiments/paper_tables.hpp"
#include "experiments/progress.hpp"
#include "experiments/score_tables.hpp"
#include "experiments/stopped.hpp"
#include "recordings/model_file.hpp"

namespace touchdown {

namespace {

/// Adds the time since its construction to the provenance.
class PhaseTimer {
 public:
  PhaseTimer(Provenance& provenance, std::string phase)
      : provenance_(provenance), phase_(std::move(phase)) {}
  ~PhaseTimer() {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    provenance_.timings.emplace_back(phase_, elapsed.count());
  }
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;

 private:
  Provenance& provenance_;
  std::string phase_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::string id_of(const Experiment& experiment, const std::vector<NamedScenario>& scenarios) {
  Fingerprint fingerprint;
  fingerprint.add(to_yaml(experiment));
  for (const NamedScenario& named : scenarios) {
    fingerprint.add(to_yaml(named.scenario)).add(read_file(named.scenario.robot));
  }
  return fingerprint.text();
}

/// Another build may compute other numbers: what it left behind is not used.
void discard_results_of_other_builds(const RunDirectory& directory) {
  const auto stamp = directory.file("state", "build");
  const std::string build = build_fingerprint() + "\n";
  if (std::filesystem::exists(stamp) && read_file(stamp) == build) return;
  for (const char* folder : {"state", "recordings", "models", "tables", "figures", "videos"}) {
    std::filesystem::remove_all(directory.path() / folder);
  }
  write_atomically(stamp, build);
}

void write_models(const FittedModels& models, const RunDirectory& directory) {
  for (const auto& [simulator, by_estimator] : models) {
    for (const auto& [estimator, model] : by_estimator) {
      const auto file = directory.file("models", fmt::format("{}_{}.npz", simulator, estimator));
      if (model.measurement) write_measurement_model(*model.measurement, file);
      if (model.phase) write_phase_model(*model.phase, file);
    }
  }
}

Table runs_table(const std::vector<PlayedRun>& runs) {
  Table table{{"simulator", "scenario", "role", "run", "outcome", "flights", "duration_s"}, {}};
  for (const PlayedRun& run : runs) {
    table.rows.push_back({run.plan.simulator, run.plan.scenario.name,
                          run.plan.role == RunRole::fit ? "fit" : "test",
                          std::to_string(run.plan.run), std::string(to_text(run.report.outcome)),
                          std::to_string(run.report.flights), metric(run.report.duration)});
  }
  return table;
}

std::vector<HeardRun> heard(const std::vector<PlayedRun>& runs, RunRole role) {
  std::vector<HeardRun> result;
  for (const PlayedRun& run : runs) {
    if (run.plan.role == role && !is_failure(run.report.outcome)) result.push_back(run.heard);
  }
  return result;
}

/// Transitions, calibration and all views in the highlighted cells.
void score_highlights(ExperimentResult& result, const std::vector<const HeardRun*>& test_runs,
                      const std::function<bool()>& going_on) {
  const Experiment& experiment = result.experiment;
  const BootstrapConfig& config = experiment.intervals.bootstrap;
  for (const NoiseCell& cell : experiment.highlights) {
    const std::vector<ConditionScores> scores = score_conditions(
        experiment, own_engine_conditions(experiment), cell, experiment.noise.seeds, test_runs,
        result.models, [&](std::int64_t /*cells*/) { return going_on(); });
    const auto summaries = summarise(scores, cell, config);
    const auto compared = differences(scores, cell, config);
    result.scores.insert(result.scores.end(), summaries.begin(), summaries.end());
    result.differences.insert(result.differences.end(), compared.begin(), compared.end());
  }
}

/// What the numbers of one cell are, in words.
std::string how_scored(const Experiment& experiment, const NoiseCell& cell) {
  return fmt::format(
      "Both wheels; torque noise {} N·m, accelerometer noise {} m/s², {} noise seeds; contact: "
      "normal force > {} N, states under {} ms merged; {:.0f} % bootstrap intervals over {}s.",
      cell.torque, cell.accelerometer, experiment.noise.seeds, experiment.labels.force_threshold,
      1e3 * experiment.labels.debounce, 100.0 * experiment.intervals.bootstrap.level,
      experiment.intervals.over == SampleUnit::run ? "run" : "drop");
}

/// The paper's tables for every highlighted cell, one below the other.
std::vector<CaptionedTable> paper_tables(const ExperimentResult& result) {
  std::vector<CaptionedTable> tables;
  for (const NoiseCell& cell : result.experiment.highlights) {
    std::vector<ScoreSummary> scores;
    std::copy_if(result.scores.begin(), result.scores.end(), std::back_inserter(scores),
                 [&](const ScoreSummary& score) { return score.cell == cell; });
    std::vector<Difference> compared;
    std::copy_if(result.differences.begin(), result.differences.end(), std::back_inserter(compared),
                 [&](const Difference& difference) { return difference.cell == cell; });
    for (CaptionedTable& table : paper_tables(scores, how_scored(result.experiment, cell))) {
      tables.push_back(std::move(table));
    }
    tables.push_back(difference_text_table(compared));
  }
  return tables;
}

void write_score_tables(const ExperimentResult& result) {
  const RunDirectory& directory = result.directory;
  directory.write_table("views.csv", views_table(result.scores));
  directory.write_table("transitions.csv", transitions_table(result.scores));
  directory.write_table("latency.csv", latency_table(result.scores));
  directory.write_table("calibration.csv", calibration_table(result.scores));
  directory.write_table("reliability.csv", reliability_table(result.scores));
  directory.write_table("differences.csv", differences_table(result.differences));
  if (!result.experiment.paper_tables) return;
  std::string markdown;
  std::string latex;
  for (const CaptionedTable& table : paper_tables(result)) {
    markdown += to_markdown(table) + "\n";
    latex += to_latex(table) + "\n";
  }
  write_atomically(directory.file("tables", "tables.md"), markdown);
  write_atomically(directory.file("tables", "tables.tex"), latex);
}

}  // namespace

std::vector<const HeardRun*> scored_runs(const std::vector<PlayedRun>& runs) {
  std::vector<const HeardRun*> scored;
  for (const PlayedRun& run : runs) {
    if (run.plan.role == RunRole::test && !is_failure(run.report.outcome)) {
      scored.push_back(&run.heard);
    }
  }
  return scored;
}

ExperimentResult run_experiment(const Experiment& experiment, const RunOptions& options) {
  const int threads = experiment.workers > 0
                          ? experiment.workers
                          : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  const auto going_on = [&] { return options.stop == nullptr || !*options.stop; };

  const std::vector<NamedScenario> scenarios = load_scenarios(experiment);
  const std::string id = id_of(experiment, scenarios);
  ExperimentResult result{experiment,
                          id,
                          RunDirectory(experiment.name, id, options.out),
                          {},
                          {},
                          noise_cells(experiment.noise),
                          {},
                          {},
                          {},
                          {options.command, threads, {}}};
  discard_results_of_other_builds(result.directory);
  write_atomically(result.directory.path() / "config.yaml", to_yaml(experiment));

  const std::vector<PlannedRun> plan = plan_runs(experiment, scenarios);
  {
    const PhaseTimer timer(result.provenance, "simulate");
    Progress progress("simulating", "runs", static_cast<std::int64_t>(plan.size()));
    result.runs = play_runs(experiment, plan, result.directory, [&] {
      progress.advance();
      return going_on();
    });
  }
  result.directory.write_table("runs.csv", runs_table(result.runs));
  const std::vector<const HeardRun*> test_runs = scored_runs(result.runs);
  if (test_runs.empty()) throw Error("no test run stayed upright: there is nothing to score");
  {
    const PhaseTimer timer(result.provenance, "fit");
    result.models = fit_models(experiment, heard(result.runs, RunRole::fit));
    write_models(result.models, result.directory);
  }
  {
    const PhaseTimer timer(result.provenance, "listen");
    const std::vector<Condition> conditions = own_engine_conditions(experiment);
    Progress progress("listening", "runs × noise",
                      sweep_size(experiment, conditions, result.cells, test_runs));
    const std::vector<ConditionCounts> counts = sweep(
        experiment, conditions, result.cells, test_runs, result.models, [&](std::int64_t cells) {
          progress.advance(cells);
          return going_on();
        });
    result.summaries = summarise(counts, result.cells, experiment.intervals.bootstrap);
  }
  {
    const PhaseTimer timer(result.provenance, "score");
    score_highlights(result, test_runs, going_on);
  }
  result.directory.write_table("success.csv", success_table(result.summaries));
  result.directory.write_table("classification.csv", classification_table(result.summaries));
  write_score_tables(result);
  write_manifest(result);
  return result;
}

void write_manifest(const ExperimentResult& result) {
  write_atomically(result.directory.path() / "manifest.json",
                   manifest(result.experiment, result.id, result.runs, result.provenance));
}

std::string summary_text(const ExperimentResult& result) {
  const Experiment& experiment = result.experiment;
  std::string text;
  for (const std::string& simulator : experiment.simulators) {
    int scored = 0;
    for (const HeardRun* run : scored_runs(result.runs)) {
      scored += run->info.simulator == simulator ? 1 : 0;
    }
    for (const NoiseCell& cell : experiment.highlights) {
      text += fmt::format(
          "\n{}: {} test runs × {} noise seeds, torque noise {} N·m, "
          "accelerometer noise {} m/s²\n\n",
          simulator, scored, experiment.noise.seeds, cell.torque, cell.accelerometer);
      text += to_text(cell_text_table(result.summaries, simulator, cell));
    }
    if (result.cells.size() > 1) {
      const std::string& first = experiment.estimators.front();
      text += fmt::format(
          "\n{}: success rate of {} by torque and accelerometer noise "
          "(* no better than always contact)\n\n",
          simulator, estimator_entry(first).title);
      text += to_text(grid_text_table(result.summaries, simulator, first, experiment.noise));
    }
  }
  if (experiment.paper_tables) {
    for (const CaptionedTable& table : paper_tables(result)) text += '\n' + to_text(table);
  }
  text += fmt::format(
      "\nBoth wheels; contact: normal force > {} N, states under {} ms merged; first {} ms not "
      "scored; {:.0f} % bootstrap intervals over {}s.\n",
      experiment.labels.force_threshold, 1e3 * experiment.labels.debounce,
      1e3 * experiment.scoring.skip, 100.0 * experiment.intervals.bootstrap.level,
      experiment.intervals.over == SampleUnit::run ? "run" : "drop");
  for (const PlayedRun& run : result.runs) {
    if (!is_failure(run.report.outcome)) continue;
    text += fmt::format("Not used: {} ({} after {:.1f} s)\n", run.plan.file,
                        to_text(run.report.outcome), run.report.duration);
  }
  return text;
}

}  // namespace touchdown
