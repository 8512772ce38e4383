#include "render/pictures/score_figures.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "experiments/config/experiment.hpp"
#include "experiments/estimators/baselines.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/results/captions.hpp"
#include "render/curves/evidence_figure.hpp"
#include "render/curves/score_figure.hpp"
#include "render/maps/density_figure.hpp"
#include "render/palette.hpp"
#include "render/pictures/stop.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

std::string title_of(const noise::NoiseCell& cell) {
  if (cell.torque == 0.0 && cell.accelerometer == 0.0) return "no noise";
  return fmt::format("noise: {} N·m, {} m/s²", cell.torque, cell.accelerometer);
}

/// The scores at the highlighted noise settings in this engine, without the constant answer and the
/// oracle.
std::vector<ScorePanel> score_panels(const experiments::ExperimentResult& result,
                                     const std::string& simulator) {
  std::vector<ScorePanel> panels;
  for (const noise::NoiseCell& cell : result.experiment.highlights) {
    ScorePanel panel{title_of(cell), {}};
    for (const experiments::ScoreSummary& score : result.scores) {
      const bool shown = score.condition.test_simulator == simulator && score.cell == cell &&
                         score.view == scoring::scored_views().front() &&
                         score.condition.estimator != experiments::always_contact_name &&
                         score.condition.estimator != "oracle";
      if (!shown) continue;
      panel.rows.push_back(
          {experiments::estimator_entry(result.experiment, score.condition.estimator).title,
           line_type_of(result.experiment.estimators, score.condition.estimator),
           score.total.calibration, score.contact_frequency, score.total.takeoff,
           score.total.landing});
    }
    if (!panel.rows.empty()) panels.push_back(std::move(panel));
  }
  return panels;
}

/// The number of whole runs that an engine's models were fitted to.
std::size_t fitted_runs(const experiments::ExperimentResult& result, const std::string& simulator) {
  std::size_t runs = 0;
  for (const experiments::Rollout& run : result.runs) {
    runs += run.plan.role == experiments::RunRole::fit && run.plan.simulator == simulator ? 1U : 0U;
  }
  return runs;
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
    if (model == models->second.end() || !model->second.grid) continue;
    const experiments::EstimatorEntry& entry = experiments::estimator_entry(experiment, estimator);
    const auto same = std::find(drawn.begin(), drawn.end(), entry.config->measurement);
    if (same != drawn.end()) {
      figure.rows[static_cast<std::size_t>(same - drawn.begin())].title += ", " + entry.title;
      continue;
    }
    drawn.push_back(entry.config->measurement);
    figure.rows.push_back({entry.title, model->second.grid->grids()});
  }
  if (figure.rows.empty()) return std::nullopt;
  figure.title = fmt::format("Torques in contact and in the air: {}, {}", experiment.name,
                             simulators::simulator_title(simulator));
  figure.caption = fmt::format(
      "Kernel densities fitted to {} without noise, both legs, seed {}; {}{}. Lines enclose 50, 90 "
      "and 99 % of a density; on the right they mark P = 0.5 and the decision threshold, 0.8. Axes "
      "cover 97 % of both densities.",
      experiments::plural(fitted_runs(result, simulator), "run"), experiment.seed,
      experiments::labels_text(experiment), experiments::setup_caption(experiment));
  return figure;
}

/// The figures of all estimators that have evidence curves, with the estimators' names.
std::vector<std::pair<std::string, EvidenceFigure>> evidence_figures(
    const experiments::ExperimentResult& result, const std::string& simulator) {
  std::vector<std::pair<std::string, EvidenceFigure>> figures;
  const experiments::Experiment& experiment = result.experiment;
  const auto models = result.models.find(simulator);
  if (models == result.models.end()) return figures;
  for (const std::string& estimator : experiment.estimators) {
    const auto fitted = models->second.find(estimator);
    if (fitted == models->second.end()) continue;
    const std::optional<EvidenceCurveSets> sets = experiments::evidence_in(fitted->second);
    if (!sets) continue;
    const auto add = [&](const std::string& name, const std::string& steps,
                         const EvidenceModel& model) {
      figures.emplace_back(
          name,
          EvidenceFigure{
              fmt::format("Evidence of each input for a wheel's contact{}: {}, {}, {}", steps,
                          experiments::estimator_entry(experiment, estimator).title,
                          experiment.name, simulators::simulator_title(simulator)),
              model,
              fmt::format(
                  "Fitted to {}{}, seed {}; {}{}. The curves form an additive model (GAM) of the "
                  "log odds of contact: values above 0 are evidence for contact, values below 0 "
                  "against it. The estimator adds the values of all curves. Each curve averages 0 "
                  "over the training data and covers all but two in a thousand of its rows. Axes "
                  "are compressed as the estimator's inputs are; those of noise levels are "
                  "logarithmic.",
                  experiments::plural(fitted_runs(result, simulator), "run"),
                  experiment.training_segments.empty() ? "" : " and segments of others",
                  experiment.seed, experiments::labels_text(experiment),
                  experiments::setup_caption(experiment))});
    };
    add(estimator, sets->without_targets ? " at steps with targets" : "", sets->usual);
    if (!sets->without_targets) continue;
    add(estimator + "_without_targets", " at steps without targets", *sets->without_targets);
  }
  return figures;
}

}  // namespace

std::vector<Figure> draw_score_figures(const experiments::ExperimentResult& result,
                                       const std::atomic<bool>* stop) {
  const experiments::Experiment& experiment = result.experiment;
  std::vector<Figure> figures;
  for (const std::string& simulator : experiment.simulators) {
    const std::string where =
        fmt::format("{}, {}", experiment.name, simulators::simulator_title(simulator));
    const auto stem = [&](const char* name) {
      stop_if_asked(stop);
      return result.directory.file("figures", fmt::format("{}_{}", name, simulator));
    };
    if (const auto densities = density_figure(result, simulator)) {
      figures.push_back(draw_density_figure(*densities, stem("densities")));
    }
    for (const auto& [estimator, evidence] : evidence_figures(result, simulator)) {
      figures.push_back(draw_evidence_figure(evidence, stem(estimator.c_str())));
    }
    const std::vector<ScorePanel> panels = score_panels(result, simulator);
    if (panels.empty() || experiments::test_runs(result, simulator).scored == 0) continue;
    const std::string scored = experiments::scored_text(result, simulator);
    figures.push_back(draw_reliability_figure(
        {"Calibration of contact probabilities: " + where, panels,
         fmt::format("{}. Every step of both wheels counts. Bars: {}. On the diagonal, the stated "
                     "probability equals the share of steps in contact. Below: steps per bin.",
                     scored, experiments::intervals_text(experiment))},
        stem("reliability")));
    figures.push_back(draw_latency_figure(
        {"Latency of takeoffs and landings: " + where, panels,
         fmt::format(
             "{}. Events of both wheels, flights of at least {:.0f} ms; early detections "
             "have negative latency. Bins of 5 ms; every histogram has its own scale. The "
             "line is the mean; ± is the standard deviation over the events that were found.",
             scored, 1e3 * experiment.scoring.minimum_flight)},
        stem("latency")));
  }
  return figures;
}

}  // namespace touchdown::render
