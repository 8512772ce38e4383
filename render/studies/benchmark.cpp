#include "render/studies/benchmark.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/files.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/fitting/fitting.hpp"
#include "experiments/plan/request.hpp"
#include "experiments/studies/benchmark.hpp"
#include "render/film/video.hpp"
#include "render/report/filmed_run.hpp"
#include "render/studies/registry.hpp"
#include "scenarios/engine.hpp"

namespace touchdown::render {

std::string setting_of(const TableRow& row) {
  return fmt::format("{}, {} sensors", row.text("robot"), row.text("sensors"));
}

std::string noise_of(const TableRow& row) {
  return fmt::format("{} N·m, {} m/s²", row.text("torque_noise_nm"),
                     row.text("accelerometer_noise_mps2"));
}

BenchmarkTables benchmark_tables(const std::filesystem::path& run_directory) {
  const auto table = [&](const char* name) {
    const std::filesystem::path file = run_directory / "tables" / name;
    return is_there(file) ? table_of(from_csv(read_file(file))) : Table();
  };
  BenchmarkTables tables{table("benchmark.csv"), table("benchmark_standings.csv"),
                         experiments::written_estimators(run_directory)};
  const Table all = std::exchange(tables.scenes, {tables.scenes.columns, {}});
  for (std::size_t i = 0; i < all.rows.size(); ++i) {
    if (TableRow(all, i).text("fitted_on") == "own") tables.scenes.rows.push_back(all.rows[i]);
  }
  return tables;
}

WorstSegment worst_segment(const std::vector<std::vector<int>>& wrong, std::size_t length) {
  WorstSegment worst{0, 0, -1};
  for (std::size_t run = 0; run < wrong.size(); ++run) {
    std::int64_t sum = 0;
    for (std::size_t k = 0; k < wrong[run].size(); ++k) {
      sum += wrong[run][k];
      if (k >= length) sum -= wrong[run][k - length];
      if (k + 1 < std::min(length, wrong[run].size()) || sum <= worst.wrong) continue;
      worst = {run, k + 1 - std::min(length, k + 1), sum};
    }
  }
  return worst;
}

namespace {

constexpr double shown = 2.0;  ///< length of a film (s)

std::vector<experiments::PlannedRun> worst_runs(const experiments::ExperimentResult& result,
                                                const TableRow& standing) {
  std::vector<experiments::PlannedRun> runs;
  for (const experiments::FinishedRun& run : result.runs) {
    const experiments::PlannedRun& plan = run.plan;
    if (plan.role == experiments::RunRole::test && !run.failed() && plan.group == 0 &&
        plan.simulator == standing.text("worst_simulator") &&
        plan.scenario.name == standing.text("worst_scene")) {
      runs.push_back(plan);
    }
  }
  return runs;
}

/// The number of wheels about which the estimator decides wrongly, at every scored step.
std::vector<int> wrong_decisions(const FilmedRun& run, const scoring::ScoringConfig& scoring) {
  const auto contact = scoring::contact_labels(run.recording, run.labels);
  const auto& decisions = run.beliefs.front().contact;
  std::vector<int> wrong(run.recording.steps());
  for (std::size_t k = scoring::first_scored_step(run.recording.info.control_period_us, scoring);
       k < wrong.size(); ++k) {
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      wrong[k] += contact[wheel][k] != decisions[wheel][k] ? 1 : 0;
    }
  }
  return wrong;
}

void film_worst_segment(const experiments::ExperimentResult& result, const TableRow& standing,
                        const noise::SensorProfile& profile, const std::atomic<bool>* stop) {
  const experiments::Experiment& experiment = result.experiment;
  const std::vector<experiments::PlannedRun> plans = worst_runs(result, standing);
  if (plans.empty()) return;
  const std::string estimator = standing.text("estimator");
  const std::vector<std::string> estimators = {estimator};
  const experiments::FittedModels models = read_models(
      result.directory.path(), experiment, standing.text("worst_simulator"), estimators);
  std::vector<FilmedRun> runs;
  std::vector<std::vector<int>> wrong;
  for (const experiments::PlannedRun& plan : plans) {
    runs.push_back(filmed(scenarios::play(plan.scenario, plan.simulator, plan.seed, plan.run),
                          experiment, profile, estimators, models,
                          experiment.highlights.front().levels()));
    wrong.push_back(wrong_decisions(runs.back(), experiment.scoring));
  }
  const double period = runs.front().recording.period();
  const WorstSegment segment =
      worst_segment(wrong, static_cast<std::size_t>(std::llround(shown / period)));
  const FilmedRun& run = runs[segment.run];
  VideoOptions options = film_of_width(0.5 * experiment.video.width);
  options.crf = 28;
  options.from = period * static_cast<double>(segment.begin);
  options.to = options.from + shown;
  options.speed = 0.5;
  options.workers = experiment.workers;
  options.labels = run.labels;
  options.progress = film_progress(fmt::format("filming {}", estimator), stop);
  render_video({run.source()}, options,
               result.directory.own_file("videos", fmt::format("worst_{}.mp4", estimator)));
}

/// Films, for every estimator, the two seconds with the most wrong decisions in the scene and
/// engine of its lowest score, on the experiment's own robot at the first highlighted noise
/// setting. The film `videos/worst_<estimator>.mp4` runs at half speed.
void film_worst_segments(const experiments::ExperimentResult& result,
                         const std::atomic<bool>* stop) {
  const experiments::Experiment& experiment = result.experiment;
  const noise::SensorProfile profile = experiments::profile_of(
      experiments::read_sensors(experiment, result.directory.path()), experiment.sensors);
  const BenchmarkTables tables = benchmark_tables(result.directory.path());
  const std::vector<TableRow> standings = tables.standings.all();
  for (const TableRow& standing : standings) {
    const TableRow& first = standings.front();  // the experiment's own robot comes first
    if (setting_of(standing) != setting_of(first) || noise_of(standing) != noise_of(first))
      continue;
    const auto& names = experiment.estimators;
    const bool is_ours = std::ranges::find(names, standing.text("estimator")) != names.end();
    if (is_ours) film_worst_segment(result, standing, profile, stop);
  }
}

}  // namespace

StudyPictures benchmark_pictures() {
  const auto film = [](const experiments::ExperimentResult& result, const std::atomic<bool>* stop) {
    if (result.experiment.studies.at<experiments::BenchmarkConfig>().clips)
      film_worst_segments(result, stop);
  };
  const auto section = [](const ReportSubject& subject) {
    write_benchmark_page(subject);
    return ReportSection{"scenes", "Scene by scene", html_of("benchmark_link.html", {})};
  };
  return {
      .is_requested = has_section<experiments::BenchmarkConfig>, .film = film, .section = section};
}

}  // namespace touchdown::render
