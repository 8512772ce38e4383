#include "render/pictures/score_figures.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "experiments/estimators/registry.hpp"
#include "experiments/tables/captions.hpp"
#include "render/curves/latency_figure.hpp"
#include "render/curves/reliability_figure.hpp"
#include "render/maps/density_figure.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

/// What scores the highlighted cell in this engine: all but the answer that never changes and the
/// one that knows.
std::vector<const experiments::ScoreSummary*> scores_of(const experiments::ExperimentResult& result,
                                                        const std::string& simulator,
                                                        const noise::NoiseCell& cell) {
  std::vector<const experiments::ScoreSummary*> scores;
  for (const experiments::ScoreSummary& score : result.scores) {
    const bool shown = score.condition.test_simulator == simulator && score.cell == cell &&
                       score.view == scoring::scored_views().front() &&
                       score.condition.estimator != experiments::always_contact_name &&
                       score.condition.estimator != "oracle";
    if (shown) scores.push_back(&score);
  }
  return scores;
}

std::string title_of(const noise::NoiseCell& cell) {
  if (cell.torque == 0.0 && cell.accelerometer == 0.0) return "no noise";
  return fmt::format("noise: {} N·m, {} m/s²", cell.torque, cell.accelerometer);
}

std::optional<DensityFigure> density_figure(const experiments::ExperimentResult& result,
                                            const std::string& simulator) {
  const experiments::Experiment& experiment = result.experiment;
  const auto models = result.models.find(simulator);
  if (models == result.models.end()) return std::nullopt;
  DensityFigure figure;
  std::vector<MeasurementConfig> drawn;
  for (const std::string& estimator : experiment.estimators) {
    const auto model = models->second.find(estimator);
    if (model == models->second.end() || !model->second.measurement) continue;
    const experiments::EstimatorEntry& entry = experiments::estimator_entry(estimator);
    const auto same = std::find(drawn.begin(), drawn.end(), entry.config->measurement);
    if (same != drawn.end()) {
      figure.rows[static_cast<std::size_t>(same - drawn.begin())].title += ", " + entry.title;
      continue;
    }
    drawn.push_back(entry.config->measurement);
    figure.rows.push_back({entry.title, model->second.measurement->grids()});
  }
  if (figure.rows.empty()) return std::nullopt;
  std::size_t runs = 0;
  for (const experiments::PlayedRun& run : result.runs) {
    runs += run.plan.role == experiments::RunRole::fit && run.plan.simulator == simulator ? 1U : 0U;
  }
  figure.title = fmt::format("Torques in contact and in the air: {}, {}", experiment.name,
                             simulators::simulator_title(simulator));
  figure.caption = fmt::format(
      "Kernel densities fitted to {} without noise, both legs, seed {}; {}. Lines enclose 50, 90 "
      "and 99 % of a density; on the right they "
      "are P = 0.5 and the decision, 0.8. Axes end where 97 % of both densities lie.",
      experiments::plural(runs, "run"), experiment.seed, experiments::labels_text(experiment));
  return figure;
}

std::optional<ReliabilityFigure> reliability_figure(const experiments::ExperimentResult& result,
                                                    const std::string& simulator) {
  const experiments::Experiment& experiment = result.experiment;
  ReliabilityFigure figure;
  for (const noise::NoiseCell& cell : experiment.highlights) {
    ReliabilityPanel panel{title_of(cell), {}};
    for (const experiments::ScoreSummary* score : scores_of(result, simulator, cell)) {
      panel.curves.push_back({experiments::estimator_entry(score->condition.estimator).title,
                              score->total.calibration, score->contact_frequency});
    }
    if (!panel.curves.empty()) figure.panels.push_back(std::move(panel));
  }
  if (figure.panels.empty()) return std::nullopt;
  figure.title = fmt::format("Do probabilities mean what they say? {}, {}", experiment.name,
                             simulators::simulator_title(simulator));
  figure.caption = fmt::format(
      "{}. Every step of both wheels counts. Bars: {}. On the "
      "diagonal a stated probability is the share of contact; below, how often each was stated.",
      experiments::scored_text(result, simulator), experiments::intervals_text(experiment));
  return figure;
}

std::optional<LatencyFigure> latency_figure(const experiments::ExperimentResult& result,
                                            const std::string& simulator) {
  const experiments::Experiment& experiment = result.experiment;
  LatencyFigure figure;
  for (const noise::NoiseCell& cell : experiment.highlights) {
    LatencyPanel panel{title_of(cell), {}};
    for (const experiments::ScoreSummary* score : scores_of(result, simulator, cell)) {
      panel.rows.push_back({experiments::estimator_entry(score->condition.estimator).title,
                            score->total.takeoff, score->total.landing});
    }
    if (!panel.rows.empty()) figure.panels.push_back(std::move(panel));
  }
  if (figure.panels.empty()) return std::nullopt;
  figure.title = fmt::format("How late takeoffs and landings are told: {}, {}", experiment.name,
                             simulators::simulator_title(simulator));
  figure.caption = fmt::format(
      "{}. Events of both wheels, flights of at least {:.0f} ms; early is negative. Bins of 5 ms, "
      "every histogram to its own height; the line is the mean, ± the standard deviation of found "
      "events.",
      experiments::scored_text(result, simulator), 1e3 * experiment.scoring.minimum_flight);
  return figure;
}

}  // namespace

std::vector<Picture> draw_score_figures(const experiments::ExperimentResult& result) {
  std::vector<Picture> pictures;
  const auto add = [&](const Figure& figure) { pictures.push_back(picture("figure", figure)); };
  for (const std::string& simulator : result.experiment.simulators) {
    const auto stem = [&](const char* name) {
      return result.directory.file("figures", fmt::format("{}_{}", name, simulator));
    };
    if (const auto densities = density_figure(result, simulator)) {
      add(draw_density_figure(*densities, stem("densities")));
    }
    if (const auto reliability = reliability_figure(result, simulator)) {
      add(draw_reliability_figure(*reliability, stem("reliability")));
    }
    if (const auto latency = latency_figure(result, simulator)) {
      add(draw_latency_figure(*latency, stem("latency")));
    }
  }
  return pictures;
}

}  // namespace touchdown::render
