#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>

#include <fmt/format.h>

#include "core/rows.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/results/captions.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/gnuplot/frame.hpp"
#include "render/studies/benchmark.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

constexpr double row_height = 26.0, mean_width = 380.0, bars_width = 96.0;
constexpr double worst_width = 230.0, words_width = 170.0, gap_y = 84.0;

/// One noise setting.
struct Panel {
  std::vector<TableRow> standings;
};

/// The ranks of neighbours that do not differ significantly.
struct TiedRanks {
  std::size_t first, last;
};

std::string title_of(const TableRow& standing, const BenchmarkTables& tables) {
  return experiments::estimator_title(estimator_of(standing), tables.external);
}

double worst_of(const TableRow& standing) { return standing.number("worst_balanced_accuracy"); }

bool differ_significantly(const BenchmarkTables& tables, const TableRow& one,
                          const TableRow& other) {
  const std::vector<TableRow> pairs = tables.pairs.all();
  return std::any_of(pairs.begin(), pairs.end(), [&](const TableRow& pair) {
    const std::string first = pair.text("first"), second = pair.text("second");
    const bool is_this_pair = pair.text("scene").empty() && setting_of(pair) == setting_of(one) &&
                              noise_of(pair) == noise_of(one) &&
                              ((first == estimator_of(one) && second == estimator_of(other)) ||
                               (second == estimator_of(one) && first == estimator_of(other)));
    const Interval difference = pair.interval("difference");
    return is_this_pair && (difference.low > 0.0 || difference.high < 0.0);
  });
}

/// The maximal groups of two or more neighbours of which no two differ significantly.
std::vector<TiedRanks> ties(const BenchmarkTables& tables, const std::vector<TableRow>& standings) {
  std::vector<TiedRanks> all;
  for (std::size_t first = 0; first < standings.size(); ++first) {
    std::size_t last = first;
    const auto joins = [&](std::size_t next) {
      for (std::size_t i = first; i < next; ++i) {
        if (differ_significantly(tables, standings[i], standings[next])) return false;
      }
      return true;
    };
    while (last + 1 < standings.size() && joins(last + 1)) ++last;
    const bool is_part = !all.empty() && all.back().last >= last;
    if (last > first && !is_part) all.push_back({first, last});
  }
  return all;
}

/// Blocks (gnuplot's `index`): for every noise setting the standings (mean, low, high, height,
/// worst, its label) and the bars (position, lower end, upper end).
std::string data_of(const std::vector<Panel>& panels, const BenchmarkTables& tables) {
  std::string text = "#mean\tlow\thigh\theight\tworst\twhere\n";
  const auto out = std::back_inserter(text);
  for (const Panel& panel : panels) {
    const std::vector<TableRow>& standings = panel.standings;
    const std::size_t count = standings.size();
    for (std::size_t i = 0; i < count; ++i) {
      const TableRow& standing = standings[i];
      const Interval mean = standing.interval("mean_balanced_accuracy");
      fmt::format_to(out, "{}\t{}\t{}\t{}\t{}\t\"{:.3f} {}, {}\"\n", number(mean.estimate),
                     number(mean.low), number(mean.high), count - 1 - i, number(worst_of(standing)),
                     worst_of(standing), standing.text("worst_scene"),
                     simulators::simulator_title(standing.text("worst_simulator")));
    }
    text += "\n\n";
    const std::vector<TiedRanks> all = ties(tables, standings);
    if (all.empty()) text += "NaN\tNaN\tNaN\n";
    for (std::size_t i = 0; i < all.size(); ++i) {
      fmt::format_to(out, "{}\t{}\t{}\n", i, static_cast<double>(count - 1 - all[i].last) - 0.3,
                     static_cast<double>(count - 1 - all[i].first) + 0.3);
    }
    text += "\n\n";
  }
  return text;
}

std::string described(const std::vector<Panel>& panels, const BenchmarkTables& tables) {
  std::string text = "Mean balanced accuracy, the best first.";
  for (const Panel& panel : panels) {
    fmt::format_to(std::back_inserter(text), " {}:", noise_of(panel.standings.front()));
    for (const TableRow& standing : panel.standings) {
      fmt::format_to(std::back_inserter(text), " {} {:.3f} (worst {:.3f}, {});",
                     title_of(standing, tables), mean_of(standing), worst_of(standing),
                     standing.text("worst_scene"));
    }
  }
  return text;
}

}  // namespace

std::filesystem::path standings_stem(const std::filesystem::path& run_directory,
                                     const TableRow& standing) {
  return run_directory / "figures" /
         fmt::format("benchmark_{}_{}", standing.text("robot"), standing.text("sensors"));
}

Figure draw_standings_figure(const BenchmarkTables& tables, const std::string& setting,
                             double level, const FigureFile& target) {
  std::vector<Panel> panels;
  std::string noise;
  double lowest = 0.99;  // an axis from 1 to 1 cannot be drawn
  for (const TableRow& standing : tables.standings.all()) {
    if (setting_of(standing) != setting) continue;
    if (panels.empty() || noise != noise_of(standing)) panels.emplace_back();
    noise = noise_of(standing);
    panels.back().standings.push_back(standing);
    const double low = standing.interval("mean_balanced_accuracy").low;
    lowest = std::fmin(lowest, std::isnan(low) ? mean_of(standing) : low);
  }
  std::vector<std::string> names;
  for (const TableRow& standing : tables.standings.all())
    names.push_back(title_of(standing, tables));
  const double names_width = 24.0 + text_width(names);
  // The table is in the order of F1; bars join neighbours by balanced accuracy.
  for (Panel& panel : panels) {
    std::ranges::stable_sort(panel.standings, std::greater<>(), mean_of);
  }
  const double height = row_height * static_cast<double>(panels.front().standings.size());
  // Printed narrow, the worst scenes are below the means, and both parts have the same width.
  const double wide = names_width + mean_width + bars_width + worst_width + words_width;
  const bool is_stacked = target.room() < 0.8 * wide;
  const double part =
      is_stacked ? std::min(mean_width, target.room() - names_width - words_width) : mean_width;
  const double worst_left = names_width + (is_stacked ? 0.0 : mean_width + bars_width);
  const double step = (is_stacked ? 2.0 : 1.0) * (height + gap_y);
  const FigureFrame frame(
      target,
      {fmt::format("Balanced accuracy by estimator: {}", setting),
       fmt::format(
           "Balanced accuracy, averaged over all scenes and engines, with {:.0f} % intervals over "
           "runs, and over fits where these were repeated. A bar joins estimators that do not "
           "differ significantly: the simultaneous bands of their paired differences include zero. "
           "On the right, the worst scene of each estimator.",
           100.0 * level),
       described(panels, tables)},
      is_stacked ? names_width + part + words_width : wide,
      static_cast<double>(panels.size()) * step);
  const std::string file = gnuplot_file(target.name() + ".dat");
  std::string commands = "unset key\nset grid noytics\n";
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const std::vector<TableRow>& standings = panels[p].standings;
    std::vector<std::string> estimators;
    for (const TableRow& standing : standings) estimators.push_back(title_of(standing, tables));
    const double top = 24.0 + static_cast<double>(p) * step;
    commands += frame.panel(names_width, top, part, height);
    commands += fmt::format(
        "set border 1\nset title {0} offset 0,-0.6\nset yrange [-0.6:{1}]\nset xrange [{2:.2f}:1]\n"
        "set xtics nomirror autofreq\nset ytics scale 0 ({3})\n"
        "set xlabel 'mean balanced accuracy'\n"
        "plot {4} index {5} using 1:4 with points lt 1 pt 7 ps 0.9, \\\n"
        "     '' index {5} using 1:4:2:3 with xerrorbars lt 1 lw 1.6 dt 1 pt 7 ps 0.9\n",
        gnuplot_text("noise: " + noise_of(standings.front())),
        static_cast<double>(standings.size()) - 0.4, std::floor(20.0 * lowest) / 20.0,
        row_tics(estimators), file, 2 * p);
    commands += "unset arrow\n";
    commands += FigureFrame::end_panel();
    commands += frame.panel(names_width + part + 14.0, top, bars_width - 28.0, height);
    commands += fmt::format(
        "unset border\nunset title\nunset xlabel\nunset xtics\nunset ytics\nset xrange [-0.5:8]\n"
        "plot {} index {} using 1:2:(0):($3-$2) with vectors nohead lc rgb '#22262b' lw 4 dt 1\n",
        file, 2 * p + 1);
    commands += FigureFrame::end_panel();
    commands += frame.panel(worst_left, is_stacked ? top + height + gap_y : top,
                            is_stacked ? part : worst_width, height);
    if (is_stacked) commands += fmt::format("set ytics scale 0 ({})\n", row_tics(estimators));
    commands += fmt::format(
        "set border 1\nset xtics nomirror 0.25\nset xrange [0:1]\nset xlabel 'worst scene'\n"
        "plot {0} index {1} using (0):4:5:(0) with vectors nohead lc rgb '#9aa1a8' lw 2 dt 1, \\\n"
        "     '' index {1} using 5:4 with points lt 2 pt 7 ps 0.8, \\\n"
        "     '' index {1} using (1):4:6 with labels left offset 1,0 font ',9'\n",
        file, 2 * p);
    commands += FigureFrame::end_panel();
  }
  return frame.draw(commands, data_of(panels, tables));
}

void draw_standings_figures(const std::filesystem::path& run_directory, double level,
                            const experiments::PrintConfig& print) {
  const BenchmarkTables tables = benchmark_tables(run_directory);
  std::string last;
  for (const TableRow& standing : tables.standings.all()) {
    const std::string stem = standings_stem(run_directory, standing).string();
    if (stem == last) continue;
    last = stem;
    draw_standings_figure(
        tables, setting_of(standing), level,
        figure_file(run_directory, std::filesystem::path(stem).filename(), print));
  }
}

}  // namespace touchdown::render
