#include "render/curves/log_figure.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::render {

namespace {

struct Curve {
  LogCurve column;
  const char* name;
  int line_type;
};

struct Panel {
  const char* label;
  std::vector<Curve> curves;
  const char* y_range;
};

std::vector<Panel> panels_of(const LogTrace& trace) {
  std::vector<Panel> panels = {
      {"knee (N·m)",
       {{LogCurve::left_knee, "left", 1}, {LogCurve::right_knee, "right", 2}},
       "[*:*]"},
      {"wheel (N·m)",
       {{LogCurve::left_wheel, "left", 1}, {LogCurve::right_wheel, "right", 2}},
       "[*:*]"},
      {"vert. acc. (m/s²)", {{LogCurve::acceleration, "without gravity", 3}}, "[*:*]"},
      {"P(contact)",
       {{LogCurve::p_contact_left, "left", 1}, {LogCurve::p_contact_right, "right", 2}},
       "[-0.03:1.03]"}};
  const auto column = static_cast<std::size_t>(LogCurve::p_takeoff);
  if (std::any_of(trace.bins().begin(), trace.bins().end(),
                  [&](const LogTrace::Bin& bin) { return !std::isnan(bin.low[column]); })) {
    panels.push_back({"P(switch)",
                      {{LogCurve::p_takeoff, "takeoff", 4}, {LogCurve::p_landing, "landing", 3}},
                      "[-0.03:1.03]"});
  }
  return panels;
}

/// Column of the data file, from 1.
int low_column(LogCurve curve) { return 3 + 2 * static_cast<int>(curve); }
constexpr int contact_column = 3 + 2 * static_cast<int>(log_curve_count);
constexpr int truth_column = contact_column + 2;
constexpr int status_column = contact_column + 4;

std::string curve_commands(const Panel& panel, const std::string& file) {
  std::string commands = fmt::format("set ylabel {} offset -0.5,0\nset yrange {}\nplot ",
                                     gnuplot_text(panel.label), panel.y_range);
  bool first = true;
  for (const Curve& curve : panel.curves) {
    const int low = low_column(curve.column);
    // The filled band has no height where low and high agree: the line is seen there.
    commands += fmt::format(
        "{}{} using 1:{}:{} with filledcurves lt {} fs transparent solid 0.35 noborder, '' using "
        "1:{} with lines lt {} lw 1 dt 1, '' using 1:{} with lines lt {} lw 1 dt 1 title {}",
        first ? "" : ", ", first ? gnuplot_text(file) : "''", low, low + 1, curve.line_type, low,
        curve.line_type, low + 1, curve.line_type, gnuplot_text(curve.name));
    first = false;
  }
  return commands + "\n";
}

/// Rows of bars as high as the share of steps that were in contact.
std::string contact_commands(const std::string& file, bool with_truth) {
  struct Row {
    int column;
    const char* name;
    const char* colour;
  };
  std::vector<Row> rows = {{contact_column + 1, "right contact", "#d55e00"},
                           {contact_column, "left contact", "#0072b2"}};
  if (with_truth) {
    rows = {
        {truth_column + 1, "true", "#9aa1a8"}, rows[0], {truth_column, "true", "#9aa1a8"}, rows[1]};
  }
  std::string tics;
  std::string plots;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    tics += fmt::format("{}'{}' {}.4", i == 0 ? "" : ", ", rows[i].name, i);
    plots += fmt::format(
        "{}{} using 1:({}):(${} > 0 ? {} + 0.8*${} : {}) with filledcurves lc rgb "
        "'{}'",
        i == 0 ? "" : ", ", i == 0 ? gnuplot_text(file) : "''", i, rows[i].column, i,
        rows[i].column, i, rows[i].colour);
  }
  return fmt::format(
      "unset ylabel\nset yrange [-0.2:{}]\nset ytics ({}) scale 0\nunset grid\n"
      "plot {}\n",
      rows.size(), tics, plots);
}

std::string status_commands(const std::string& file) {
  std::string plots;
  for (int i = 0; i < 4; ++i) {
    plots += fmt::format(
        "{}{} using (0.5*($1+$2)):(${} > 0 ? {} : NaN) with points pt 5 ps 0.35 lc rgb '{}'",
        i == 0 ? "" : ", ", i == 0 ? gnuplot_text(file) : "''", status_column + i, 3 - i,
        i == 0 ? "#9aa1a8" : "#d55e00");
  }
  return "set yrange [-0.6:3.6]\n"
         "set ytics ('signals good' 3, 'invalid' 2, 'gap' 1, 'frozen' 0) scale 0\n"
         "set format x '%g'\nset xlabel 'time (s)'\nplot " +
         plots + "\n";
}

}  // namespace

Figure draw_log(const LogTrace& trace, const std::string& title,
                const std::filesystem::path& stem) {
  if (trace.bins().empty()) throw InputError("there is no step to draw");
  const std::string file = stem.filename().string() + ".dat";
  const std::vector<Panel> panels = panels_of(trace);
  const double begin = trace.bins().front().begin;
  double end = begin;
  bool with_truth = false;
  for (const LogTrace::Bin& bin : trace.bins()) {
    end = std::max(end, bin.end);
    with_truth = with_truth || bin.with_truth > 0;
  }
  std::string commands = fmt::format(
      "set multiplot layout {},1 title {} font ',11' margins 0.13,0.97,0.06,0.94 spacing 0,0.015\n"
      "set xrange [{}:{}]\nset ytics nomirror autofreq\nset format x ''\n"
      "set key top left horizontal\n",
      panels.size() + 2, gnuplot_text(title), begin, end > begin ? end : begin + 1.0);
  for (const Panel& panel : panels) commands += curve_commands(panel, file);
  commands += "unset key\n" + contact_commands(file, with_truth) + status_commands(file);
  // Both files are drawn from one script: it must begin as it was.
  commands +=
      "unset multiplot\nset grid back lc rgb '#dfe3e6' lw 0.6 dt 1\n"
      "set key noautotitle samplen 2.5 spacing 1.1\nset ytics nomirror autofreq\n"
      "unset xlabel\n";
  return draw_figure(stem, 1000, 1000, commands, {{file, trace.table()}});
}

}  // namespace touchdown::render
