#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/estimators/baselines.hpp"
#include "experiments/results/captions.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/figures/figures.hpp"
#include "render/gnuplot/facets.hpp"
#include "render/gnuplot/frame.hpp"
#include "render/palette.hpp"
#include "scoring/score.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {
namespace {

std::vector<std::string> names_in(const ScoreFigure& figure) {
  std::vector<std::string> names;
  for (const ScoreRow& row : figure.panels.front().rows) names.push_back(row.name);
  return names;
}

std::string title_of(const noise::NoiseCell& cell) {
  if (cell.torque == 0.0 && cell.accelerometer == 0.0) return "no noise";
  return fmt::format("noise: {} N·m, {} m/s²", cell.torque, cell.accelerometer);
}

bool is_constant(const std::string& estimator) {
  return estimator == experiments::always_contact_name || estimator == "oracle";
}

/// The scores at the highlighted noise settings in this engine, without the constant answer and the
/// oracle.
std::vector<ScorePanel> score_panels(const experiments::ExperimentResult& result,
                                     const std::string& simulator) {
  std::vector<ScorePanel> panels;
  for (const noise::NoiseCell& cell : result.experiment.highlights) {
    ScorePanel panel{title_of(cell), {}};
    const auto is_shown = [&](const TableRow& row) {
      return row.text("simulator") == simulator && experiments::is_at(row, cell) &&
             row.text("view") == scoring::scored_views().front();
    };
    const std::vector<TableRow> scores = result.tables.scores.all();
    for (std::size_t i = 0; i < scores.size(); ++i) {
      const std::string estimator = scores[i].text("estimator");
      if (is_constant(estimator) || !is_shown(scores[i])) continue;
      const scoring::Score& total = result.tables.totals[i];
      panel.rows.push_back({experiments::estimator_entry(result.experiment, estimator).title,
                            line_type_of(result.experiment.estimators, estimator), total.takeoff,
                            total.landing});
    }
    if (!panel.rows.empty()) panels.push_back(std::move(panel));
  }
  return panels;
}

}  // namespace

experiments::FigureSpec reliability_figure(const Table& reliability,
                                           const experiments::Experiment& experiment,
                                           const std::string& simulator) {
  experiments::FigureSpec spec{.name = "reliability_" + simulator, .table = "reliability.csv"};
  spec.where = {{"simulator", simulator}, {"view", scoring::scored_views().front()}};
  spec.panels = experiments::noise_panels(reliability);
  spec.series = experiments::groups_in(reliability, "estimator", experiments::titles_in(experiment),
                                       spec.where);
  std::erase_if(spec.series.groups,
                [](const auto& group) { return is_constant(group.values.front()); });
  spec.colour_order = experiment.estimators;
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
  spec.title = fmt::format("Calibration of contact probabilities: {}, {}", experiment.name,
                           simulators::simulator_title(simulator));
  return spec;
}

namespace {

constexpr double panel_width = 310.0, row_height = 42.0, numbers = 150.0;
constexpr double gap_y = 94.0, right_margin = 12.0;

struct LatencyKind {
  const char* name;
  scoring::TransitionCounts ScoreRow::*counts;
};
constexpr std::array<LatencyKind, 2> kinds = {
    {{"takeoff", &ScoreRow::takeoff}, {"landing", &ScoreRow::landing}}};

/// A histogram's outline on `base`. A bin's height is its share of the fullest bin.
std::string outline(const scoring::LatencyHistogram& histogram, double base) {
  const auto& events = histogram.events;
  const std::int32_t most = *std::max_element(events.begin(), events.end());
  if (most == 0) return "NaN\tNaN\tNaN\n";
  constexpr double highest = 0.82, half = 0.5e-3 * scoring::LatencyHistogram::width_us;
  std::string text;
  for (std::size_t b = 0; b < events.size(); ++b) {
    const double x = scoring::LatencyHistogram::centre_ms(b);
    const double y = base + highest * events[b] / most;
    for (const double edge : {x - half, x + half}) {
      fmt::format_to(std::back_inserter(text), "{}\t{}\t{}\n", edge, base, y);
    }
  }
  return text;
}

/// A number with a typographic minus sign; zero has no sign.
std::string signed_text(double value) {
  std::string text = fmt::format("{:.1f}", std::abs(value));
  return value < 0.0 && text != "0.0" ? "−" + text : text;
}

/// The data file: blocks (gnuplot's `index`) by panel, kind and estimator with the histogram's
/// outline (latency in ms, base, top); then one block per panel and kind with a row per estimator:
/// its mean, its base, and the label beside it.
std::string latency_data(const ScoreFigure& figure) {
  std::string text = "#latency_ms\tbase\theight\n";
  std::string means;
  for (const ScorePanel& panel : figure.panels) {
    for (const LatencyKind& kind : kinds) {
      for (std::size_t r = 0; r < panel.rows.size(); ++r) {
        const scoring::TransitionCounts& counts = panel.rows[r].*kind.counts;
        const auto base = static_cast<double>(panel.rows.size() - 1 - r);
        text += outline(counts.latency, base) + "\n\n";
        const double mean = 1e3 * counts.latency_mean();
        const double deviation = 1e3 * counts.latency_deviation();
        std::string label = counts.detected > 0 ? signed_text(mean) : "–";
        if (std::isfinite(deviation)) label += fmt::format(" ± {:.1f} ms", deviation);
        means += fmt::format("{}\t{}\t\"{}\\n{} of {} found\"\n", number(mean), base, label,
                             counts.detected, counts.events);
      }
      means += "\n\n";
    }
  }
  return text + "#mean_ms\tbase\ttext\n" + means;
}

/// The range of all histograms of one kind (ms).
std::array<double, 2> range_of(const ScoreFigure& figure, const LatencyKind& kind) {
  scoring::LatencyHistogram all;
  for (const ScorePanel& panel : figure.panels) {
    for (const ScoreRow& row : panel.rows) all += (row.*kind.counts).latency;
  }
  std::array<double, 2> range = {-30.0, 50.0};
  for (std::size_t b = 0; b < all.events.size(); ++b) {
    if (all.events[b] == 0) continue;
    range[0] = std::min(range[0], scoring::LatencyHistogram::centre_ms(b) - 5.0);
    range[1] = std::max(range[1], scoring::LatencyHistogram::centre_ms(b) + 5.0);
  }
  return range;
}

std::string latency_described(const ScoreFigure& figure) {
  std::string text = "Mean latencies in milliseconds, takeoff / landing.";
  for (const ScorePanel& panel : figure.panels) {
    text += fmt::format(" {}:", panel.title);
    for (std::size_t r = 0; r < panel.rows.size(); ++r) {
      const ScoreRow& row = panel.rows[r];
      text += fmt::format("{} {} {:.1f} / {:.1f}", r > 0 ? "," : "", row.name,
                          1e3 * row.takeoff.latency_mean(), 1e3 * row.landing.latency_mean());
    }
    text += '.';
  }
  return text;
}

}  // namespace

Figure draw_latency_figure(const ScoreFigure& figure, const FigureFile& target) {
  if (figure.panels.empty() || figure.panels.front().rows.empty()) {
    throw InputError("a latency figure without rows");
  }
  const std::size_t rows = figure.panels.front().rows.size();
  const double height = row_height * static_cast<double>(rows);
  const double names = 24.0 + text_width(names_in(figure));
  const PanelColumns across = columns_in(target.room(), names + numbers + right_margin,
                                         {kinds.size(), panel_width, numbers});
  const std::size_t lines = figure.panels.size() * kinds.size() / across.count;
  const FigureFrame frame(
      target, {figure.title, figure.caption, latency_described(figure)},
      names + across.left(across.count - 1) + across.width + numbers + right_margin,
      static_cast<double>(lines) * (height + gap_y));
  const std::string file = gnuplot_file(target.name() + ".dat");
  std::string commands = fmt::format(
      "unset key\nset grid noytics\nset style fill solid 0.55\nset yrange [-0.15:{}]\nset border "
      "1\n",
      static_cast<double>(rows));
  std::size_t block = 0, means = figure.panels.size() * kinds.size() * rows;
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    std::string estimators;
    for (std::size_t r = 0; r < rows; ++r) {
      estimators +=
          fmt::format("{}{} {}", r > 0 ? ", " : "", gnuplot_text(figure.panels[p].rows[r].name),
                      static_cast<double>(rows - 1 - r) + 0.3);
    }
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const auto [low, high] = range_of(figure, kinds[k]);
      const std::size_t place = p * kinds.size() + k;
      const std::size_t line = place / across.count;
      const bool is_first = place % across.count == 0;
      commands +=
          frame.panel(names + across.left(place % across.count),
                      24.0 + static_cast<double>(line) * (height + gap_y), across.width, height);
      commands += fmt::format(
          "set title {} offset 0,-0.6\nset xrange [{}:{}]\nset ytics scale 0 ({})\n"
          "set xtics {}\nset xlabel '{} latency (ms)'\n"
          "set arrow from 0,graph 0 to 0,graph 1 nohead back lc rgb '#6b747d' lw 1.2 dt 1\nplot ",
          gnuplot_text(figure.panels[p].title), low, high, is_first ? estimators : "'' 0",
          tick_step(high - low, across.width / 45.0), kinds[k].name);
      for (std::size_t r = 0; r < rows; ++r) {
        commands += fmt::format(
            "{0} index {1} using 1:2:3 with filledcurves lt {2}, {0} index {1} using 1:3 with "
            "lines lt {2} lw 1.2 dt 1, \\\n     ",
            file, block++, figure.panels[p].rows[r].line_type);
      }
      commands += fmt::format(
          "{0} index {1} using 1:2:(0):(0.9) with vectors nohead lw 1.8 dt 1 lc rgb '#101418', \\\n"
          "     '' index {1} using ({2}):($2+0.4):3 with labels left offset 1.2,0 font ',9' "
          "textcolor rgb '#22262b'\n",
          file, means++, high);
      commands += FigureFrame::end_panel();
    }
  }
  return frame.draw(commands, latency_data(figure));
}

void draw_scores(const experiments::ExperimentResult& result, const std::atomic<bool>* stop) {
  const experiments::Experiment& experiment = result.experiment;
  for (const std::string& simulator : experiment.simulators) {
    const std::string where =
        fmt::format("{}, {}", experiment.name, simulators::simulator_title(simulator));
    const auto target = [&](const char* name) {
      stop_if_asked(stop);
      return figure_file(result, fmt::format("{}_{}", name, simulator));
    };
    const std::vector<ScorePanel> panels = score_panels(result, simulator);
    if (panels.empty() || experiments::test_runs(result, simulator).scored == 0) continue;
    const std::string scored = experiments::scored_text(result, simulator);
    experiments::FigureSpec reliability =
        reliability_figure(result.tables.reliability, experiment, simulator);
    reliability.caption = fmt::format(
        "{}. Every step of both wheels counts. Bars: {}. On the diagonal, the stated "
        "probability equals the share of steps in contact. Below: steps per bin.",
        scored, experiments::intervals_text(experiment));
    experiments::FigureSpec brier = reliability;
    std::swap(brier.rows, brier.series);
    brier.measures = {{.column = "brier", .title = "Brier score"}};
    reliability.alt =
        "Share of steps in contact against the stated probability of contact. Brier scores:" +
        experiments::values_text(brier, result.tables.scores);
    draw_facets(reliability, result.tables.reliability, target("reliability"));
    draw_latency_figure(
        {"Latency of takeoffs and landings: " + where, panels,
         fmt::format(
             "{}. Events of both wheels, flights of at least {:.0f} ms; early detections "
             "have negative latency. Bins of 5 ms; every histogram has its own scale. The "
             "line is the mean; ± is the standard deviation over the events that were found.",
             scored, 1e3 * experiment.scoring.minimum_flight)},
        target("latency"));
  }
}

}  // namespace touchdown::render
