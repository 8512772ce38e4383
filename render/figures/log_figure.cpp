#include "render/figures/log_figure.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "render/gnuplot/figure.hpp"

namespace touchdown::render {

namespace {

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? NAN : static_cast<double>(part) / static_cast<double>(whole);
}

void append(std::string& text, double value) { text.append(number(value)).append(1, '\t'); }

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
  const auto has_values = [&](LogCurve curve) {
    const auto column = static_cast<std::size_t>(curve);
    return std::any_of(trace.bins().begin(), trace.bins().end(),
                       [&](const LogTrace::Bin& bin) { return !std::isnan(bin.low[column]); });
  };
  if (has_values(LogCurve::load_left) || has_values(LogCurve::load_right)) {
    panels.push_back({"load (N)",
                      {{LogCurve::load_left, "left", 1}, {LogCurve::load_right, "right", 2}},
                      "[*:*]"});
  }
  if (has_values(LogCurve::p_takeoff)) {
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

std::string plot(const std::string& file, const std::vector<std::string>& columns) {
  return fmt::format("plot {} using {}\n", gnuplot_file(file), fmt::join(columns, ", '' using "));
}

std::string curve_commands(const Panel& panel, const std::string& file) {
  std::vector<std::string> columns;
  for (const auto& [column, name, line_type] : panel.curves) {
    const int low = low_column(column);
    // Both wheels often agree: the first curve is seen on both sides of the second one.
    const double width = column == panel.curves.back().column ? 1.0 : 3.0;
    // Where low and high agree, the filled band has no height and the line shows the value.
    columns.push_back(
        fmt::format("1:{}:{} with filledcurves lt {} fs transparent solid 0.35 noborder", low,
                    low + 1, line_type));
    columns.push_back(fmt::format("1:{} with lines lt {} lw {} dt 1", low, line_type, width));
    columns.push_back(fmt::format("1:{} with lines lt {} lw {} dt 1 title {}", low + 1, line_type,
                                  width, gnuplot_text(name)));
  }
  return fmt::format("set ylabel {} offset -0.5,0\nset yrange {}\nset key maxrows {}\n",
                     gnuplot_text(panel.label), panel.y_range, panel.curves.size()) +
         plot(file, columns);
}

/// Rows of bars; their height is the share of steps in contact.
std::string contact_commands(const std::string& file, bool with_truth) {
  struct Bars {
    int column;
    const char* name;
    const char* colour;
  };
  std::vector<Bars> rows = {{contact_column + 1, "right contact", "#d55e00"},
                            {contact_column, "left contact", "#0072b2"}};
  if (with_truth) {
    rows = {
        {truth_column + 1, "true", "#9aa1a8"}, rows[0], {truth_column, "true", "#9aa1a8"}, rows[1]};
  }
  std::vector<std::string> tics, columns;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    tics.push_back(fmt::format("'{}' {}.4", rows[i].name, i));
    columns.push_back(
        fmt::format("1:({0}):(${1} > 0 ? {0} + 0.8*${1} : {0}) with filledcurves lc rgb '{2}'", i,
                    rows[i].column, rows[i].colour));
  }
  return fmt::format("unset ylabel\nset yrange [-0.2:{}]\nset ytics ({}) scale 0\nunset grid\n",
                     rows.size(), fmt::join(tics, ", ")) +
         plot(file, columns);
}

std::string status_commands(const std::string& file) {
  std::vector<std::string> columns;
  for (int i = 0; i < 4; ++i) {
    columns.push_back(
        fmt::format("(0.5*($1+$2)):(${} > 0 ? {} : NaN) with points pt 5 ps 0.35 lc rgb '{}'",
                    status_column + i, 3 - i, i == 0 ? "#9aa1a8" : "#d55e00"));
  }
  return "set yrange [-0.6:3.6]\n"
         "set ytics ('signals good' 3, 'invalid' 2, 'gap' 1, 'frozen' 0) scale 0\n"
         "set format x '%g'\nset xlabel 'time (s)'\n" +
         plot(file, columns);
}

}  // namespace

LogTraceStep log_trace_step(const Signals& signals, const Belief& belief,
                            const Evidence& evidence) {
  LogTraceStep step;
  step.time = signals.time;
  step.value = {
      signals.leg[0].knee.torque,  signals.leg[1].knee.torque,    signals.leg[0].wheel.torque,
      signals.leg[1].wheel.torque, signals.vertical_acceleration, belief.wheel[0].p_contact,
      belief.wheel[1].p_contact,   evidence.transition.p_takeoff, evidence.transition.p_landing,
      belief.wheel[0].load.force,  belief.wheel[1].load.force};
  step.contact = {belief.wheel[0].contact, belief.wheel[1].contact};
  step.status = is_used(belief.status) ? SignalStatus::good : belief.status;
  return step;
}

LogTrace::Bin::Bin(const LogTraceStep& step)
    : begin(step.time), end(step.time), steps(1), low(step.value), high(step.value) {
  for (std::size_t wheel = 0; wheel < 2; ++wheel) {
    contact[wheel] = step.contact[wheel] ? 1 : 0;
    true_contact[wheel] = step.true_contact && (*step.true_contact)[wheel] ? 1 : 0;
  }
  with_truth = step.true_contact ? 1 : 0;
  status[static_cast<std::size_t>(step.status)] = 1;
}

void LogTrace::Bin::merge(const Bin& later) {
  end = later.end;
  steps += later.steps;
  with_truth += later.with_truth;
  for (std::size_t i = 0; i < log_curve_count; ++i) {
    // NaN means no value; at infinity a curve leaves the plot.
    low[i] = std::fmin(low[i], later.low[i]);
    high[i] = std::fmax(high[i], later.high[i]);
  }
  for (std::size_t wheel = 0; wheel < 2; ++wheel) {
    contact[wheel] += later.contact[wheel];
    true_contact[wheel] += later.true_contact[wheel];
  }
  for (std::size_t i = 0; i < status.size(); ++i) status[i] += later.status[i];
}

void LogTrace::add(const LogTraceStep& step) {
  if (!bins_.empty() && bins_.back().steps < steps_per_bin_) {
    bins_.back().merge(Bin(step));
    return;
  }
  if (bins_.size() >= most_bins_) {
    for (std::size_t i = 0; 2 * i < bins_.size(); ++i) {
      Bin merged = bins_[2 * i];
      if (2 * i + 1 < bins_.size()) merged.merge(bins_[2 * i + 1]);
      bins_[i] = merged;
    }
    bins_.erase(bins_.begin() + static_cast<std::ptrdiff_t>((bins_.size() + 1) / 2), bins_.end());
    steps_per_bin_ *= 2;
    add(step);
    return;
  }
  bins_.emplace_back(step);
}

std::string LogTrace::table() const {
  std::string text =
      "# begin_s\tend_s\tlow and high of: left knee, right knee, left wheel, right wheel (N m), "
      "vertical acceleration (m/s2), p_contact left, right, p_takeoff, p_landing, load left, right "
      "(N)\tshare of steps "
      "decided as contact: left, right\ttrue contact: left, right\tsteps good, invalid, gap, "
      "frozen\n";
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    const Bin& bin = bins_[i];
    const std::size_t gap = static_cast<std::size_t>(SignalStatus::gap);
    if (i > 0 && bin.status[gap] > 0) text += '\n';
    append(text, bin.begin);
    append(text, bin.end);
    for (std::size_t c = 0; c < log_curve_count; ++c) {
      append(text, bin.low[c]);
      append(text, bin.high[c]);
    }
    for (const std::size_t steps : bin.contact) append(text, share(steps, bin.steps));
    for (const std::size_t steps : bin.true_contact) append(text, share(steps, bin.with_truth));
    for (const std::size_t steps : bin.status) append(text, static_cast<double>(steps));
    text.back() = '\n';
  }
  return text;
}

Figure draw_log(const LogTrace& trace, const std::string& title,
                const std::filesystem::path& stem) {
  if (trace.bins().empty()) throw InputError("there is no step to draw");
  const std::string file = stem.filename().string() + ".dat";
  const std::vector<Panel> panels = panels_of(trace);
  double begin = trace.bins().front().begin;  // of all: time may go back
  double end = begin;
  bool with_truth = false;
  for (const LogTrace::Bin& bin : trace.bins()) {
    begin = std::min({begin, bin.begin, bin.end});
    end = std::max({end, bin.begin, bin.end});
    with_truth = with_truth || bin.with_truth > 0;
  }
  std::string commands = fmt::format(
      "set multiplot layout {},1 title {} font ',11' margins 0.13,0.83,0.06,0.94 spacing 0,0.024\n"
      "set xrange [{}:{}]\nset ytics nomirror autofreq font ',9'\nset format x ''\n"
      "set key at graph 1.02, graph 1 left top Left reverse samplen 1.5\n",
      panels.size() + 2, gnuplot_text(title), begin, end > begin ? end : begin + 1.0);
  for (const Panel& panel : panels) commands += curve_commands(panel, file);
  commands += "unset key\n" + contact_commands(file, with_truth) + status_commands(file);
  constexpr std::size_t usual_panels = 5;
  const int height =
      1000 + 200 * static_cast<int>(std::max(panels.size(), usual_panels) - usual_panels);
  return draw_figure(stem, 1000, height, commands + end_multiplot, {{file, trace.table()}});
}

}  // namespace touchdown::render
