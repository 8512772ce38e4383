#include "experiments/studies/moments.hpp"

#include <array>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "core/rows.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/gnuplot/frame.hpp"
#include "render/studies/registry.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {

namespace {

constexpr double torque_width = 330.0, density_curve_height = 170.0, moments_height = 66.0,
                 torque_left = 112.0;
constexpr double torque_gap_x = 74.0, torque_gap_y = 72.0, torque_top = 26.0;

struct TorquePanel {
  const char* joint;
  const char* contact;
  const char* title;
};
constexpr std::array torque_panels = {
    TorquePanel{"knee", "1", "knee, in contact"}, TorquePanel{"wheel", "1", "wheel, in contact"},
    TorquePanel{"knee", "0", "knee, in the air"}, TorquePanel{"wheel", "0", "wheel, in the air"}};

/// Mean and standard deviation (N·m).
struct Moments {
  std::string title;
  double mean, deviation;
};

std::vector<TableRow> rows_of(const Table& table, const TorquePanel& panel) {
  return where(table.all(), [&](const TableRow& row) {
    return row.text("joint") == panel.joint && row.text("contact") == panel.contact;
  });
}

/// A panel's moments: one entry per engine, then the real robot's.
std::vector<Moments> moments_of(const Table& table, const TorquePanel& panel) {
  std::vector<Moments> all;
  Moments robot;
  for (const TableRow& row : rows_of(table, panel)) {
    all.push_back({std::string(simulators::simulator_title(row.text("simulator"))),
                   row.number("mean_nm"), row.number("sd_nm")});
    robot = {"the real robot", row.number("robot_mean_nm"), row.number("robot_sd_nm")};
  }
  all.push_back(robot);
  return all;
}

/// The panel's data blocks: a curve per engine, then the moments, one line each.
std::string torque_data(const Table& moments, const Table& densities, const TorquePanel& panel) {
  std::string text;
  for (const TableRow& row : rows_of(moments, panel)) {
    std::string curve;
    for (const TableRow& point : rows_of(densities, panel)) {
      if (point.text("simulator") != row.text("simulator")) continue;
      curve += fmt::format("{}\t{}\n", point.text("torque_nm"), point.text("density_per_nm"));
    }
    text += (curve.empty() ? "NaN\tNaN\n" : curve) + "\n\n";
  }
  const std::vector<Moments> all = moments_of(moments, panel);
  for (std::size_t i = 0; i < all.size(); ++i) {
    text +=
        fmt::format("{}\t{}\t{}\n", number(all[i].mean), number(all[i].deviation), all.size() - i);
  }
  return text + "\n\n";
}

/// The end of the panel's axis: 2.5 deviations above every mean.
double torque_axis_end(const std::vector<Moments>& all) {
  double end = 0.0;
  for (const Moments& one : all) end = std::fmax(end, one.mean + 2.5 * one.deviation);
  return end;
}

std::string moment_bars(const std::vector<Moments>& all, const std::string& file, std::size_t block,
                        bool names) {
  std::string tics;
  std::string plots;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_robot = i + 1 == all.size();
    fmt::format_to(std::back_inserter(tics), "{}{} {}", i > 0 ? ", " : "",
                   names ? gnuplot_text(all[i].title) : "''", all.size() - i);
    fmt::format_to(std::back_inserter(plots),
                   "{}{} index {} every ::{}::{} using 1:3:2 with xerrorbars {} lw 2 dt 1 pt 7 ps "
                   "0.9 notitle",
                   i > 0 ? ", " : "", file, block, i, i,
                   is_robot ? "lc rgb '#22262b'" : fmt::format("lt {}", i + 1));
  }
  return fmt::format(
      "set yrange [0.4:{}]\nset ytics scale 0 ({})\nset format x ''\nunset xlabel\nunset "
      "ylabel\nplot {}\n",
      static_cast<double>(all.size()) + 0.6, tics, plots);
}

std::string density_curves(const std::vector<Moments>& all, const std::string& file,
                           std::size_t block, bool is_first_column) {
  std::string plots;
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    fmt::format_to(std::back_inserter(plots), "{}{} index {} using 1:2 with lines lt {} lw 1.6",
                   i > 0 ? ", " : "", file, block + i, i + 1);
  }
  return fmt::format(
      "set yrange [0:*]\nset ytics autofreq scale 0.5\nset format '%g'\nset xlabel '|torque| "
      "(N·m)' "
      "offset 0,0.4\nset ylabel {} offset 0,0\nplot {}\n",
      is_first_column ? "'density (1/(N·m))'" : "''", plots);
}

std::string moments_described(const Table& moments) {
  std::string text = "Torques of the simulated and the real robot: mean and standard deviation.";
  for (const TorquePanel& panel : torque_panels) {
    fmt::format_to(std::back_inserter(text), " {}:", panel.title);
    for (const Moments& one : moments_of(moments, panel)) {
      fmt::format_to(std::back_inserter(text), " {} {:.3f} ± {:.3f},", one.title, one.mean,
                     one.deviation);
    }
    text.back() = '.';
  }
  return text;
}

}  // namespace

Figure draw_moments_figure(const Table& moments, const Table& densities, const FigureFile& target) {
  const PanelColumns columns =
      columns_in(target.room(), torque_left + 24.0, {2, torque_width, torque_gap_x}, 150.0);
  const FigureFrame frame(
      target,
      {"Torques of the simulated and the real robot",
       "Curves: densities of the simulated joints' |torque| as their servos report it, in bins of "
       "0.01 N·m. Points and bars above them: mean ± one standard deviation. The real robot has no "
       "curve, because its published densities include their kernels.",
       moments_described(moments)},
      torque_left + columns.left(1) + columns.width + 24.0,
      torque_top + 2.0 * (moments_height + density_curve_height) + torque_gap_y + 50.0);
  const std::string file = gnuplot_file(target.name() + ".dat");
  std::string commands = "unset key\nset grid xtics noytics\nset border 3\nset tics nomirror\n";
  std::string data = "#torque_nm\tdensity_per_nm, then #mean_nm\tsd_nm\trow\n";
  std::size_t block = 0;
  for (std::size_t p = 0; p < torque_panels.size(); ++p) {
    const std::vector<Moments> all = moments_of(moments, torque_panels[p]);
    const std::size_t row = p / 2;
    const std::size_t column = p % 2;
    const double left = torque_left + columns.left(column);
    const double top = torque_top + static_cast<double>(row) *
                                        (moments_height + density_curve_height + torque_gap_y);
    commands += frame.panel(left, top, columns.width, moments_height) +
                fmt::format("set title {} offset 0,-0.6\nset xrange [0:{}]\n",
                            gnuplot_text(torque_panels[p].title), number(torque_axis_end(all))) +
                moment_bars(all, file, block + all.size() - 1, column == 0) +
                FigureFrame::end_panel();
    commands += frame.panel(left, top + moments_height, columns.width, density_curve_height) +
                "unset title\n" + density_curves(all, file, block, column == 0) +
                FigureFrame::end_panel();
    data += torque_data(moments, densities, torque_panels[p]);
    block += all.size();
  }
  return frame.draw(commands, data);
}

StudyPictures moments_pictures() {
  return {.is_requested = has_section<experiments::MomentsConfig>,
          .draw = [](const experiments::ExperimentResult& result) {
            draw_moments_figure(result.directory.read_table("moments.csv"),
                                result.directory.read_table("torque_densities.csv"),
                                figure_file(result, "moments"));
          }};
}

}  // namespace touchdown::render
