#include <fmt/format.h>

#include "experiments/config/experiment.hpp"
#include "experiments/estimators/baselines.hpp"
#include "experiments/results/captions.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/figures/figures.hpp"
#include "render/gnuplot/facets.hpp"
#include "scoring/score.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {
namespace {

bool is_constant(const std::string& estimator) {
  return estimator == experiments::always_contact_name || estimator == "oracle";
}

/// Curves of both wheels in one engine, a series per estimator and a panel per noise setting. The
/// constant answer and the oracle have none.
experiments::FigureSpec score_figure(const Table& table, const std::string& name,
                                     const std::string& title,
                                     const experiments::Experiment& experiment,
                                     const std::string& simulator) {
  experiments::FigureSpec spec;
  spec.name = fmt::format("{}_{}", name, simulator);
  spec.where = {{"simulator", simulator}, {"view", scoring::scored_views().front()}};
  spec.panels = experiments::noise_panels(table);
  spec.series =
      experiments::groups_in(table, "estimator", experiments::titles_in(experiment), spec.where);
  std::erase_if(spec.series.groups,
                [](const auto& group) { return is_constant(group.values.front()); });
  spec.colour_order = experiment.estimators;
  spec.title =
      fmt::format("{}: {}, {}", title, experiment.name, simulators::simulator_title(simulator));
  return spec;
}

/// The numbers of a column of the scores, by the panels and series of a figure.
std::string numbers_text(experiments::FigureSpec figure, const experiments::FigureAxis& column,
                         const Table& scores) {
  std::swap(figure.rows, figure.series);
  figure.measures = {column};
  return experiments::values_text(figure, scores);
}

}  // namespace

experiments::FigureSpec reliability_figure(const Table& reliability,
                                           const experiments::Experiment& experiment,
                                           const std::string& simulator) {
  experiments::FigureSpec spec = score_figure(
      reliability, "reliability", "Calibration of contact probabilities", experiment, simulator);
  spec.x = {.column = "mean_probability",
            .title = "stated probability of contact",
            .from = 0.0,
            .to = 1.0};
  experiments::FigureAxis share =
      experiments::axis_with_interval("contact_frequency", "share of steps in contact");
  share.from = 0.0;
  share.to = 1.0;
  share.has_diagonal = true;
  spec.measures = {share,
                   {.column = "steps", .title = "steps", .scale = experiments::AxisScale::log}};
  return spec;
}

experiments::FigureSpec latency_figure(const Table& latencies,
                                       const experiments::Experiment& experiment,
                                       const std::string& simulator) {
  experiments::FigureSpec spec =
      score_figure(latencies, "latency", "Latency of takeoffs and landings", experiment, simulator);
  spec.x = {.column = "latency_ms", .title = "latency", .unit = "ms"};
  for (const char* event : {"takeoff", "landing"}) {
    spec.measures.push_back({.column = fmt::format("{}s_found", event),
                             .title = fmt::format("share of {}s found", event),
                             .from = 0.0,
                             .to = 1.0});
  }
  spec.marks = {{experiments::MarkShape::step}};
  return spec;
}

void draw_scores(const experiments::ExperimentResult& result, const std::atomic<bool>* stop) {
  const experiments::Experiment& experiment = result.experiment;
  const experiments::ScoreTables& tables = result.tables;
  for (const std::string& simulator : experiment.simulators) {
    if (experiments::test_runs(result, simulator).scored == 0) continue;
    const std::string scored = experiments::scored_text(result, simulator);
    experiments::FigureSpec reliability =
        reliability_figure(tables.reliability, experiment, simulator);
    reliability.caption = fmt::format(
        "{}. Every step of both wheels counts. Bars: {}. On the diagonal, the stated "
        "probability equals the share of steps in contact. Below: steps per bin.",
        scored, experiments::intervals_text(experiment));
    reliability.alt =
        "Share of steps in contact against the stated probability of contact. Brier scores:" +
        numbers_text(reliability, {.column = "brier", .title = "Brier score"}, tables.scores);
    stop_if_asked(stop);
    draw_facets(reliability, tables.reliability, figure_file(result, reliability.name));
    experiments::FigureSpec latency = latency_figure(tables.latencies, experiment, simulator);
    latency.caption = fmt::format(
        "{}. Takeoffs and landings of both wheels, flights of at least {:.0f} ms, that are found "
        "up to this latency, in bins of 5 ms. Early detections have negative latency; what a curve "
        "lacks to 1 is missed. tables/latency.csv has means and deviations.",
        scored, 1e3 * experiment.scoring.minimum_flight);
    latency.alt = "Shares of events that are found up to a latency.";
    for (const char* event : {"takeoff", "landing"}) {
      const std::string column = fmt::format("{}_latency_ms", event);
      latency.alt +=
          fmt::format(" Mean latencies of {}s:{}", event,
                      numbers_text(latency, {.column = column, .title = "latency", .unit = "ms"},
                                   tables.scores));
    }
    stop_if_asked(stop);
    draw_facets(latency, tables.latencies, figure_file(result, latency.name));
  }
}

}  // namespace touchdown::render
