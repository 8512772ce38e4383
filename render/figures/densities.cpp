#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <opencv2/imgproc.hpp>

#include "core/error.hpp"
#include "core/table.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/results/captions.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/figures/figures.hpp"
#include "render/gnuplot/frame.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {
namespace {

/// The shares of a density's probability within its contour lines.
constexpr std::array<double, 3> enclosed_shares = {0.5, 0.9, 0.99};
/// The contact probabilities with a contour line: undecided, and the filter's decision threshold.
constexpr std::array<double, 2> probability_levels = {0.5, 0.8};
/// Densities are clipped below at this share of their peak.
constexpr double faintest_density = 1e-4;
/// The axes cover the region with this share of both densities.
constexpr double shown_share = 0.97;
/// Along an axis with more points than this, only every n-th is drawn.
constexpr int most_points = 200;

/// Widens a range by a margin, within 0 and `count`.
void add_margin(int& begin, int& length, int count) {
  const int margin = std::max(2, length / 8);
  const int end = std::min(count, begin + length + margin);
  begin = std::max(0, begin - margin);
  length = end - begin;
}

/// The drawn part of the grids (x: columns, along the knee's axis; y: rows, along the wheel's): the
/// region with 97 % of both densities and a margin. A vanishing density is ignored.
cv::Rect window_of(const LikelihoodGrids& grids) {
  const DensityPeaks peaks = peaks_of(grids);
  cv::Rect window;
  for (const auto& [grid, peak] :
       {std::pair(&grids.contact, peaks.contact), std::pair(&grids.no_contact, peaks.no_contact)}) {
    if (!(peak > 0.0)) continue;
    const cv::Mat density = cv::Mat(*grid).reshape(1, grids.wheel.count);
    window |= cv::boundingRect(density >= density_level(*grid, shown_share));
  }
  if (window.empty()) return {0, 0, grids.knee.count, grids.wheel.count};
  add_margin(window.x, window.width, grids.knee.count);
  add_margin(window.y, window.height, grids.wheel.count);
  return window;
}

/// The levels of a density's contour lines as shares of its peak, or those of the probability, as
/// gnuplot lists them. `value`: column of the data file.
std::string contour_levels(const LikelihoodGrids& grids, int value) {
  if (value == 5) return fmt::format("{}", fmt::join(probability_levels, ","));
  const std::vector<double>& grid = value == 3 ? grids.contact : grids.no_contact;
  const DensityPeaks peaks = peaks_of(grids);
  std::vector<std::string> levels;
  for (const double share : enclosed_shares) {
    levels.push_back(
        number(density_level(grid, share) / (value == 3 ? peaks.contact : peaks.no_contact)));
  }
  return fmt::format("{}", fmt::join(levels, ","));
}

double share_of_peak(double density, double peak) {
  return peak > 0.0 ? std::max(density / peak, faintest_density) : faintest_density;
}

std::string points(const LikelihoodGrids& grids, const std::vector<double>& probability,
                   const cv::Rect& window) {
  const DensityPeaks peaks = peaks_of(grids);
  const int row_step = 1 + (window.height - 1) / most_points;
  const int column_step = 1 + (window.width - 1) / most_points;
  std::string text = "#knee_nm\twheel_nm\tcontact\tno_contact\tp_contact\n";
  for (int r = window.y; r < window.y + window.height; r += row_step) {
    for (int c = window.x; c < window.x + window.width; c += column_step) {
      const auto i = static_cast<std::size_t>(r * grids.knee.count + c);
      fmt::format_to(std::back_inserter(text), "{:.5g}\t{:.5g}\t{:.4g}\t{:.4g}\t{:.4g}\n",
                     grids.knee[c], grids.wheel[r], share_of_peak(grids.contact[i], peaks.contact),
                     share_of_peak(grids.no_contact[i], peaks.no_contact), probability[i]);
    }
    text += '\n';
  }
  return text + "\n";
}

/// A density figure's data file. Its block of each row (gnuplot's `index`) has knee torque, wheel
/// torque, both densities as shares of their peaks, P(contact).
std::string density_data(const DensityFigure& figure) {
  std::string text;
  for (const DensityRow& row : figure.rows) {
    text += points(row.grids, contact_probability(row.grids), window_of(row.grids));
  }
  return text;
}

constexpr double density_width = 268.0, density_height = 216.0, density_left = 76.0,
                 density_gap_x = 62.0;
constexpr double density_gap_y = 104.0, density_bar = 12.0, density_top = 46.0;

struct DensityColumn {
  const char* title;
  const char* palette;
  const char* scale;  ///< of its colours
  int value;          ///< column of the data file
  const char* bar_label;
};
constexpr const char* density_scale =
    "set logscale cb\nset cbrange [1e-4:1]\n"
    "set cbtics ('10⁻⁴' 1e-4, '10⁻³' 1e-3, '10⁻²' 1e-2, '0.1' 0.1, '1' 1)\n";
constexpr DensityColumn density_columns[] = {
    {"in contact", "(0 '#ffffff', 1 '#b9d7ea', 2 '#5aa5d1', 3 '#0072b2', 4 '#00304d')",
     density_scale, 3, "density, share of its peak"},
    {"in the air", "(0 '#ffffff', 1 '#f6d3b8', 2 '#ec9656', 3 '#d55e00', 4 '#5c2800')",
     density_scale, 4, "density, share of its peak"},
    {"P(contact), flat prior", "(0 '#d55e00', 1 '#f3c4a0', 2 '#f7f7f7', 3 '#9fcae6', 4 '#0072b2')",
     "unset logscale cb\nset cbrange [0:1]\nset cbtics (0, 0.2, 0.5, 0.8, 1)\n", 5,
     "probability of contact"}};

bool vanishes(const LikelihoodGrids& grids, int value) {
  const DensityPeaks peaks = peaks_of(grids);
  return (value == 3 && peaks.contact == 0.0) || (value == 4 && peaks.no_contact == 0.0);
}

/// The panel's points and lines, or a note in place of a vanishing density.
std::string plot(const DensityRow& row, const std::string& file, std::size_t block, int value) {
  if (vanishes(row.grids, value)) {
    return fmt::format(
        "set label {} at graph 0.5, graph 0.55 center textcolor rgb '#40464e'\nplot NaN\n",
        gnuplot_text("all its torques lie\noutside the model's axes"));
  }
  return fmt::format(
      "plot {0} index {1} using 1:2:{2} with image, \\\n"
      "     $lines_{1}_{2} using 1:2 with lines lc rgb '#101418' lw {3} dt 1\n",
      file, block, value, value == 5 ? 1.1 : 0.8);
}

/// Commands that find the contour lines of all panels, for `plot`.
std::string contour_commands(const DensityFigure& figure, const std::string& file) {
  // The lines of a table are separated by blanks.
  std::string text = "set datafile separator whitespace\nset contour base\nunset surface\n";
  for (std::size_t row = 0; row < figure.rows.size(); ++row) {
    for (const DensityColumn& column : density_columns) {
      if (vanishes(figure.rows[row].grids, column.value)) continue;
      fmt::format_to(std::back_inserter(text),
                     "set cntrparam levels discrete {}\nset table $lines_{}_{}\n"
                     "splot {} index {} using 1:2:{}\nunset table\n",
                     contour_levels(figure.rows[row].grids, column.value), row, column.value, file,
                     row, column.value);
    }
  }
  return text + "unset contour\nset surface\n";
}

std::string described(const DensityFigure& figure) {
  std::string text =
      "Densities of knee and wheel torques with a wheel in contact and in the air, and the "
      "resulting probability of contact.";
  for (const DensityRow& row : figure.rows) {
    const DensityPeaks peaks = peaks_of(row.grids);
    text += fmt::format(" {}: the peaks are {:.3g} and {:.3g} per square newton metre.", row.title,
                        peaks.contact, peaks.no_contact);
  }
  return text;
}

/// The number of whole runs that an engine's models were fitted to.
std::size_t fitted_runs(const experiments::ExperimentResult& result, const std::string& simulator) {
  return static_cast<std::size_t>(
      std::ranges::count_if(result.runs, [&](const experiments::FinishedRun& run) {
        return run.plan.role == experiments::RunRole::fit && run.plan.simulator == simulator;
      }));
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
    const auto same = std::find(drawn.begin(), drawn.end(), *entry.fitting.torques);
    if (same != drawn.end()) {
      figure.rows[static_cast<std::size_t>(same - drawn.begin())].title += ", " + entry.title;
      continue;
    }
    drawn.push_back(*entry.fitting.torques);
    figure.rows.push_back({entry.title, model->second.grid->grids()});
  }
  if (figure.rows.empty()) return std::nullopt;
  figure.title = fmt::format("Torques in contact and in the air: {}, {}", experiment.name,
                             simulators::simulator_title(simulator));
  figure.caption = fmt::format(
      "Kernel densities fitted to {} without noise, both legs, seed {}; {}{}. Lines enclose 50 %, "
      "90 % and 99 % of a density; on the right they mark P = 0.5 and the decision threshold, 0.8. "
      "Axes "
      "cover 97 % of both densities.",
      experiments::plural(fitted_runs(result, simulator), "run"), experiment.seed,
      experiments::labels_text(experiment), experiments::setup_caption(experiment));
  return figure;
}

}  // namespace

double density_level(const std::vector<double>& grid, double share) {
  std::vector<double> sorted = grid;
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  const double all = std::accumulate(sorted.begin(), sorted.end(), 0.0);
  if (!(all > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  for (const double value : sorted) {
    sum += value;
    if (sum >= share * all) return value;
  }
  return sorted.back();
}

DensityPeaks peaks_of(const LikelihoodGrids& grids) {
  constexpr double vanishing = 1e-12;
  DensityPeaks peaks{*std::max_element(grids.contact.begin(), grids.contact.end()),
                     *std::max_element(grids.no_contact.begin(), grids.no_contact.end())};
  const double highest = std::max(peaks.contact, peaks.no_contact);
  if (peaks.contact < vanishing * highest) peaks.contact = 0.0;
  if (peaks.no_contact < vanishing * highest) peaks.no_contact = 0.0;
  return peaks;
}

DensityAxes axes_of(const LikelihoodGrids& grids) {
  const cv::Rect window = window_of(grids);
  return {grids.knee[window.x], grids.knee[window.x + window.width - 1], grids.wheel[window.y],
          grids.wheel[window.y + window.height - 1]};
}

Figure draw_density_figure(const DensityFigure& figure, const FigureFile& target) {
  if (figure.rows.empty()) throw InputError("a density figure without models");
  // Printed narrow, a model's panels are below each other, with their scales between them, and
  // models are side by side.
  const double margins = density_left + 30.0;
  const std::size_t kinds = std::size(density_columns), models = figure.rows.size();
  PanelColumns across =
      columns_in(target.room(), margins, {kinds, density_width, density_gap_x}, density_width);
  const bool is_stacked = across.count < kinds;
  if (is_stacked) {
    across = columns_in(target.room(), margins, {models, density_width, density_gap_x}, 150.0);
  }
  const std::size_t beside = is_stacked ? across.count : 1, below = is_stacked ? kinds : 1;
  const std::size_t blocks = (models + beside - 1) / beside;
  std::vector<std::string> titles;
  double title_height = 0.0;  // of the lines above the last one
  for (const DensityRow& row : figure.rows) {
    const double letters = is_stacked ? (across.width + 40.0) / text_width({"x"}) : 1e3;
    titles.push_back(wrapped(row.title, static_cast<std::size_t>(letters)));
    const auto breaks = static_cast<double>(std::ranges::count(titles.back(), '\n'));
    title_height = std::max(title_height, 18.0 * breaks);
  }
  const double step = density_height + density_gap_y + (is_stacked ? 64.0 : 0.0);
  const FigureFrame frame(
      target, {figure.title, figure.caption, described(figure)},
      density_left + across.left(across.count - 1) + across.width + 30.0,
      density_top +
          static_cast<double>(blocks) * (title_height + static_cast<double>(below) * step) -
          density_gap_y + (is_stacked ? 62.0 : 126.0));
  const std::string file = gnuplot_file(target.name() + ".dat");
  std::string commands =
      "unset key\nset border 15\nset tics out\nunset grid\n"
      "set xlabel 'knee torque (N·m)' offset 0,0.3\nset xtics autofreq\n";
  for (std::size_t r = 0; r < figure.rows.size(); ++r) {
    const DensityAxes axes = axes_of(figure.rows[r].grids);
    for (std::size_t c = 0; c < std::size(density_columns); ++c) {
      const DensityColumn& column = density_columns[c];
      const std::size_t block = r / beside, line = block * below + (is_stacked ? c : 0);
      const double left = density_left + across.left(is_stacked ? r % beside : c);
      const double top = density_top + static_cast<double>(block + 1) * title_height +
                         static_cast<double>(line) * step;
      commands += frame.panel(left, top, across.width, density_height);
      if (c == 0) {
        commands += frame.label(titles[r], left, top - 34.0 - title_height, "left font ',11'");
      }
      commands +=
          r + 1 == figure.rows.size() || is_stacked
              ? frame.colour_bar(left, top + density_height + 62.0, across.width, density_bar) +
                    fmt::format("set cblabel '{}' offset 0,0.5\n", column.bar_label)
              : "unset colorbox\n";
      commands += fmt::format(
          "set title '{}' offset 0,-0.7\nset palette defined {}\n{}"
          "set xrange [{:.5g}:{:.5g}]\nset yrange [{:.5g}:{:.5g}]\nset ylabel '{}' offset 1,0\n",
          column.title, column.palette, column.scale, axes.knee_low, axes.knee_high, axes.wheel_low,
          axes.wheel_high, left == density_left ? "wheel torque (N·m)" : "");
      commands += plot(figure.rows[r], file, r, column.value) + FigureFrame::end_panel();
    }
  }
  return frame.draw(contour_commands(figure, file) + frame.begin() + commands,
                    {{target.name() + ".dat", density_data(figure)}});
}

void draw_densities(const experiments::ExperimentResult& result, const std::atomic<bool>* stop) {
  for (const std::string& simulator : result.experiment.simulators) {
    stop_if_asked(stop);
    if (const auto densities = density_figure(result, simulator)) {
      draw_density_figure(*densities, figure_file(result, "densities_" + simulator));
    }
  }
}

}  // namespace touchdown::render
