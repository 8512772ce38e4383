#include "render/operating_points/front_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "experiments/results/captions.hpp"
#include "render/gnuplot/frame.hpp"
#include "render/gnuplot/text.hpp"
#include "render/palette.hpp"
#include "render/report/tables.hpp"

namespace touchdown::render {

namespace {

constexpr double side = 330.0, between_panels = 84.0, left_of_panels = 76.0, beside_panels = 220.0;
constexpr double fewest = 0.3;  // extra switches per minute: the axis begins here

/// The Pareto front of one estimator in one noise setting.
struct Front {
  std::string estimator;
  std::vector<std::array<double, 2>> points;  ///< extra switches per minute, error (%)
  std::array<double, 2> own = {};             ///< of its own thresholds, likewise
};

struct FrontPanel {
  std::string title;
  std::vector<Front> fronts;
};

std::vector<FrontPanel> panels_of(const Table& table) {
  std::vector<FrontPanel> panels;
  for (const std::vector<std::string>& row : table.rows) {
    const auto text = [&](const char* column) { return cell(table, row, column); };
    const std::string title =
        fmt::format("{} N·m, {} m/s²", text("torque_noise_nm"), text("accelerometer_noise_mps2"));
    if (panels.empty() || panels.back().title != title) panels.push_back({title, {}});
    std::vector<Front>& fronts = panels.back().fronts;
    const std::string estimator = text("estimator");
    const std::array<double, 2> point = {
        std::max(fewest, number(text("extra_switches_per_minute"))),
        100.0 * (1.0 - number(text("balanced_accuracy")))};
    const bool is_own = text("leave_below").empty();
    if (is_own) fronts.push_back({estimator, {}, point});
    if (text("on_front") != "1") continue;
    const auto its_front = std::find_if(fronts.begin(), fronts.end(), [&](const Front& front) {
      return front.estimator == estimator;
    });
    its_front->points.push_back(point);
  }
  for (FrontPanel& panel : panels) {
    for (Front& front : panel.fronts) std::sort(front.points.begin(), front.points.end());
  }
  return panels;
}

/// One block (gnuplot's `index`) per panel and estimator with its front, then one each with the
/// point of its own decision.
std::string data_of(const std::vector<FrontPanel>& panels) {
  std::string curves = "#extra_switches_per_minute\terror_percent\n";
  std::string own;
  const auto line = [](const std::array<double, 2>& point) {
    return fmt::format("{:.6g}\t{:.6g}\n", point[0], point[1]);
  };
  for (const FrontPanel& panel : panels) {
    for (const Front& front : panel.fronts) {
      for (const auto& point : front.points) curves += line(point);
      curves += "\n\n";
      own += line(front.own) + "\n\n";
    }
  }
  return curves + own;
}

/// The range of one axis over the points of all panels, with a margin.
std::string range_of(const std::vector<FrontPanel>& panels, std::size_t coordinate) {
  double least = HUGE_VAL;
  double most = 0.0;
  const auto reach = [&](const std::array<double, 2>& point) {
    least = std::min(least, point[coordinate]);
    most = std::max(most, point[coordinate]);
  };
  for (const FrontPanel& panel : panels) {
    for (const Front& front : panel.fronts) {
      reach(front.own);
      std::for_each(front.points.begin(), front.points.end(), reach);
    }
  }
  return fmt::format("[{:.6g}:{:.6g}]", 0.8 * std::max(least, 1e-3), 1.25 * most);
}

std::string described(const std::vector<FrontPanel>& panels) {
  std::string text = "Error against extra switches.";
  for (const FrontPanel& panel : panels) {
    fmt::format_to(std::back_inserter(text), " {}:", panel.title);
    for (const Front& front : panel.fronts) {
      fmt::format_to(std::back_inserter(text),
                     " {} by its own decision {:.2f} % with {:.1f} per minute;",
                     experiments::estimator_title(front.estimator), front.own[1], front.own[0]);
    }
    text.back() = '.';
  }
  return text;
}

}  // namespace

Figure draw_operating_points_figure(const Table& operating_points,
                                    const std::vector<std::string>& estimators,
                                    const std::string& conditions,
                                    const std::filesystem::path& stem) {
  const std::vector<FrontPanel> panels = panels_of(operating_points);
  std::size_t blocks = 0;
  for (const FrontPanel& panel : panels) blocks += panel.fronts.size();
  const FigureFrame frame(
      "Balanced error against extra switches",
      fmt::format(
          "1 − balanced accuracy against extra switches of the decision, both averaged over "
          "scenes and engines ({}). Each curve is the Pareto front of one estimator over "
          "decision thresholds on its P(contact); a ring marks its own thresholds. Values "
          "below {} extra switches per minute are drawn at that value.",
          conditions, fewest),
      left_of_panels + static_cast<double>(panels.size()) * (side + between_panels) -
          between_panels + beside_panels,
      side + 84.0);
  const std::string file = gnuplot_text(stem.filename().string() + ".dat");
  std::string commands = fmt::format(
      "set logscale xy\nset xrange {}\nset yrange {}\nset format x '%g'\nset format y '%g'\n"
      "set xlabel 'extra switches per minute'\n",
      range_of(panels, 0), range_of(panels, 1));
  std::size_t block = 0;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const FrontPanel& panel = panels[i];
    commands += frame.panel(left_of_panels + static_cast<double>(i) * (side + between_panels), 26.0,
                            side, side);
    commands +=
        fmt::format("set title {} offset 0,-0.6\nset ylabel {}\n", gnuplot_text(panel.title),
                    i == 0 ? "'1 − balanced accuracy (%)'" : "''");
    commands += i == 0 ? fmt::format("set key at screen {}, screen {} left top Left reverse\n",
                                     1.0 - (beside_panels - 22.0) / frame.width(),
                                     1.0 - 66.0 / frame.height())
                       : "unset key\n";
    commands += "plot ";
    for (std::size_t e = 0; e < panel.fronts.size(); ++e, ++block) {
      const std::string& estimator = panel.fronts[e].estimator;
      const std::size_t line_type = line_type_of(estimators, estimator);
      commands += fmt::format(
          "{}{} index {} using 1:2 with linespoints lt {} pt 7 ps 0.5 title {}, \\\n     {} index "
          "{} using 1:2 with points lt {} pt 6 ps 1.6 lw 2 notitle",
          e == 0 ? "" : ", \\\n     ", file, block, line_type,
          gnuplot_text(experiments::estimator_title(estimator)), file, blocks + block, line_type);
    }
    commands += '\n' + FigureFrame::end_panel();
  }
  return frame.draw(stem, commands, data_of(panels), described(panels));
}

}  // namespace touchdown::render
