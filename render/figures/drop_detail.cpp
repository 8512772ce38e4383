#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "experiments/plan/request.hpp"
#include "experiments/plan/rollouts.hpp"
#include "experiments/results/captions.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/figures/figures.hpp"
#include "render/gnuplot/frame.hpp"
#include "render/palette.hpp"
#include "scenarios/engine.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {
namespace {

enum Row : std::size_t {
  height,
  knee,
  wheel,
  evidence,
  belief,
  true_spectrum,
  noisy_spectrum,
  transition
};

/// Spectra are drawn over octaves, log2 of the frequency in Hz: takeoffs and landings differ below
/// 30 Hz.
constexpr double lowest_octave = 1.0, highest_octave = 9.0, rows_per_octave = 8.0;
constexpr double smallest_magnitude = -20.0, largest_magnitude = 50.0;  ///< of the colours (dB)

struct Axis {
  double low, high;
};

/// An axis that includes zero and is a little wider than the data.
Axis range_of(const std::vector<const std::vector<double>*>& all) {
  Axis axis{0.0, 0.0};
  for (const std::vector<double>* values : all) {
    for (const double value : *values) {
      if (!std::isfinite(value)) continue;
      axis.low = std::min(axis.low, value);
      axis.high = std::max(axis.high, value);
    }
  }
  const double margin = std::max(0.01, 0.06 * (axis.high - axis.low));
  return {axis.low - margin, axis.high + margin};
}

/// The axis over all noise settings, so that columns share it.
Axis range_of(const experiments::DropDetail& detail,
              std::vector<double> experiments::TorqueTrace::*joint) {
  std::vector<const std::vector<double>*> all = {&(detail.torque.*joint)};
  for (const experiments::NoisyDrop& drop : detail.noisy) all.push_back(&(drop.torque.*joint));
  return range_of(all);
}

/// Columns of a data file, by name.
class PlotColumns {
 public:
  void add(std::string name, std::vector<double> values) {
    if (!values_.empty() && values.size() != values_.front().size()) {
      throw Error(fmt::format("column {} has {} values, the others have {}", name, values.size(),
                              values_.front().size()));
    }
    names_.push_back(std::move(name));
    values_.push_back(std::move(values));
  }

  /// The column's number in scripts, from 1. Errors: `Error` without such a column.
  int number_of(const std::string& name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) throw Error(fmt::format("there is no column {}", name));
    return static_cast<int>(found - names_.begin()) + 1;
  }

  /// A line of names after `#`, then one line per step. All columns have the same length.
  std::string text() const {
    std::string text = fmt::format("# {}\n", fmt::join(names_, "\t"));
    const std::size_t rows = values_.empty() ? 0 : values_.front().size();
    for (std::size_t row = 0; row < rows; ++row) {
      for (const std::vector<double>& column : values_) text.append(number(column[row])) += '\t';
      text.back() = '\n';
    }
    return text;
  }

 private:
  std::vector<std::string> names_;
  std::vector<std::vector<double>> values_;
};

/// Converts seconds into the milliseconds of a time axis.
std::vector<double> in_ms(std::vector<double> seconds) {
  // Rounded to the nanosecond: the product alone would be 345.00000000000006.
  for (double& time : seconds) time = std::round(1e9 * time) / 1e6;
  return seconds;
}

/// Commands that tint the time in contact behind the curves, and mark its edges in front of images.
/// `time` is in ms, with one entry per step.
std::string contact_bands(const std::vector<double>& time, const std::vector<bool>& contact) {
  std::string text = "unset object\nunset arrow\n";
  for (std::size_t begin = 0; begin < time.size();) {
    std::size_t end = begin + 1;
    while (end < time.size() && contact[end] == contact[begin]) ++end;
    const double until = end < time.size() ? time[end] : time.back();
    if (contact[begin]) {
      text += fmt::format(
          "set object rectangle from first {}, graph 0 to first {}, graph 1 behind "
          "fillcolor rgb '#dceee0' fillstyle solid noborder\n",
          time[begin], until);
    }
    if (end < time.size()) {
      text += fmt::format(
          "set arrow from first {0}, graph 0 to first {0}, graph 1 nohead front lw 1 dt 2 "
          "lc rgb '#5d666f'\n",
          until);
    }
    begin = end;
  }
  return text;
}

/// The data of one noise setting, a line per step.
PlotColumns detail_columns(const experiments::DropDetail& detail,
                           const experiments::NoisyDrop& drop) {
  PlotColumns columns;
  columns.add("time_ms", in_ms(detail.time));
  columns.add("contact", {detail.contact.begin(), detail.contact.end()});
  columns.add("height_m", detail.height);
  columns.add("knee_torque_nm", detail.torque.knee);
  columns.add("noisy_knee_torque_nm", drop.torque.knee);
  columns.add("wheel_torque_nm", detail.torque.wheel);
  columns.add("noisy_wheel_torque_nm", drop.torque.wheel);
  columns.add("torque_evidence", drop.torque_evidence);
  columns.add("acceleration_mps2", detail.spectrum.acceleration);
  columns.add("noisy_acceleration_mps2", drop.spectrum.acceleration);
  columns.add("power_m2ps4", detail.spectrum.power);
  columns.add("noisy_power_m2ps4", drop.spectrum.power);
  columns.add("median_frequency_hz", detail.spectrum.median_frequency);
  columns.add("noisy_median_frequency_hz", drop.spectrum.median_frequency);
  columns.add("p_switch", drop.spectrum.p_switch);
  columns.add("p_takeoff", drop.spectrum.p_takeoff);
  columns.add("p_landing", drop.spectrum.p_landing);
  for (const experiments::BeliefTrace& trace : drop.beliefs)
    columns.add("p_" + trace.estimator, trace.p_contact);
  return columns;
}

struct DetailColumn {
  const experiments::DropDetail& detail;
  const PanelGrid& grid;
  std::size_t number;
  const PlotColumns& columns;
  const std::string& name;                     ///< of the figure's files
  const std::vector<std::string>& estimators;  ///< all of the experiment's
  const std::map<Row, std::size_t>& rows;      ///< places of the drawn ones

  std::string commands() const {
    std::string text =
        contact_bands(in_ms(detail.time), {detail.contact.begin(), detail.contact.end()});
    text += panel(height, "height\n(m)");
    const Axis heights = range_of({&detail.height});
    text += fmt::format(
        "set yrange [{}:{}]\nset ytics -10,0.1\n"
        "plot NaN with boxes fillcolor rgb '#dceee0' title 'left wheel in contact', {}\n"
        "set ytics autofreq\n",
        heights.low, heights.high,
        line("height_m", "lc rgb '#009e73' lw 2.2",
             detail.at ? "base, above time zero" : "base, above takeoff"));
    text += torques(knee, "knee torque\n(N·m)", "knee_torque_nm", &experiments::TorqueTrace::knee);
    text +=
        torques(wheel, "wheel torque\n(N·m)", "wheel_torque_nm", &experiments::TorqueTrace::wheel);
    if (rows.contains(evidence)) text += torque_evidence();
    text += beliefs();
    text += spectrum(true_spectrum, 0, "true acceleration\nfrequency (Hz)", "");
    text += spectrum(noisy_spectrum, number + 1, "noisy acceleration\nfrequency (Hz)", "noisy_");
    text += panel(transition, "P(switch)\nat one step");
    text += "set yrange [-0.04:1.04]\nset ytics 0,0.5,1\nplot " +
            line("p_switch", "lc rgb '#8a9299' lw 1.8", "takeoff or landing") + ", " +
            line("p_takeoff", "lc rgb '#e69f00' lw 2.2", "takeoff") + ", " +
            line("p_landing", "lc rgb '#7b3294' lw 2.2", "landing") + "\n";
    return text;
  }

  bool last() const { return number + 1 == detail.noisy.size(); }

  std::string panel(Row row, std::string_view label) const {
    const bool has_ticks_right = row == true_spectrum || row == noisy_spectrum;
    return grid.panel(rows.at(row), number, label) +
           (last() ? grid.key(rows.at(row), has_ticks_right ? 56.0 : 14.0) : "");
  }

  std::string line(const std::string& column, const std::string& style,
                   const std::string& title) const {
    return fmt::format("'{}_{}.dat' using 1:{} with lines {} dt 1 title {}", name, number + 1,
                       columns.number_of(column), style, gnuplot_text(title));
  }

  std::string torques(Row row, std::string_view label, const std::string& column,
                      std::vector<double> experiments::TorqueTrace::*joint) const {
    const Axis axis = range_of(detail, joint);
    return panel(row, label) +
           fmt::format(
               "set yrange [{}:{}]\nset ytics autofreq {}\nplot {}, {}\nset ytics autofreq\n",
               axis.low, axis.high, tick_step(axis.high - axis.low, 6.0),
               line("noisy_" + column, "lc rgb '#8fb9dd' lw 1", row == knee ? "with noise" : ""),
               line(column, "lc rgb '#08306b' lw 1.8", row == knee ? "true" : ""));
  }

  std::string torque_evidence() const {
    constexpr double most = 12.0;  // larger values mean certainty, and would flatten the rest
    return panel(evidence, "torque evidence\n(nats)") +
           fmt::format(
               "set yrange [-{0}:{0}]\nset ytics -{0},{0}\nset clip two\nplot 0 with lines lc "
               "rgb '#8a9299' lw 1 dt 1 notitle, {1}\nset ytics autofreq\n",
               most, line("torque_evidence", "lc rgb '#0072b2' lw 1.6", "log likelihood ratio"));
  }

  std::string beliefs() const {
    // Drawn from the last to the first, which is on top; the key keeps the order of the list.
    std::string text = panel(belief, "P(contact)") + (last() ? "set key invert\n" : "") +
                       "set yrange [-0.04:1.04]\nset ytics 0,0.5,1\nplot ";
    const auto& traces = detail.noisy[number].beliefs;
    for (std::size_t i = traces.size(); i-- > 0;) {
      text += line("p_" + traces[i].estimator,
                   fmt::format("lt {} {}", line_type_of(estimators, traces[i].estimator),
                               curve_width(traces.size() - 1 - i, traces.size())),
                   traces[i].title) +
              (i == 0 ? "" : ", ");
    }
    return text + "\nset ytics autofreq\nset key noinvert\n";
  }

  std::string spectrum(Row row, std::size_t file, std::string_view label,
                       const std::string& which) const {
    const double first = 1e3 * detail.time.front();
    const double step = 1e3 * experiments::spectrum_stride *
                        (detail.time.size() > 1 ? detail.time[1] - detail.time[0] : 1e-3);
    std::string text = panel(row, label);
    text += fmt::format(
        "set yrange [{}:{}]\nset ytics ('2' 1, '8' 3, '32' 5, '128' 7, '512' 9)\n"
        "set cbrange [{}:{}]\nset y2range [0.1:1e5]\nset logscale y2\n{}",
        lowest_octave, highest_octave, smallest_magnitude, largest_magnitude,
        number == 0 ? "" : "set ytics ('' 1, '' 3, '' 5, '' 7, '' 9)\n");
    if (last()) {
      text += "set y2tics ('1' 1, '100' 100, '10⁴' 1e4) font ',11' textcolor rgb '#b04a10'\n";
    }
    text +=
        last() && row == noisy_spectrum
            ? grid.colour_bar(rows.at(row), 92.0, 16.0) +
                  "set cblabel 'dB of m²/s⁴' font ',11' offset 1.2,0\nset cbtics 20 font ',11'\n"
            : "unset colorbox\n";
    // A dark edge makes the lines visible on every colour.
    const auto edged = [&](const std::string& values, const std::string& axes,
                           const std::string& colour, const std::string& title) {
      const std::string from = fmt::format("'{}_{}.dat' using 1:{} axes {} with lines dt 1", name,
                                           number + 1, values, axes);
      return fmt::format("{} lc rgb '#101418' lw 3.4 notitle, {} lc rgb '{}' lw 1.8 title {}", from,
                         from, colour, gnuplot_text(row == true_spectrum ? title : ""));
    };
    text += fmt::format(
        "plot '{}_spectrum_{}.dat' matrix using ({}+{}*$1):({}+$2/{}):3 with image notitle, "
        "{} axes x1y2 with lines lc rgb '#ffb38a' lw 1.2 dt (6,4) title {}, {}, {}\n",
        name, file, first, step, lowest_octave, rows_per_octave, detail.switch_power,
        gnuplot_text(row == true_spectrum ? "power at P(switch) = ½" : ""),
        edged(std::to_string(columns.number_of(which + "power_m2ps4")), "x1y2", "#ff7b3d",
              "power (m²/s⁴, right)"),
        edged(fmt::format("(log(2 > ${0} ? 2 : ${0})/log(2))",
                          columns.number_of(which + "median_frequency_hz")),
              "x1y1", "#56d0ff", "median frequency"));
    return text + "unset logscale y2\nunset y2tics\nset ytics autofreq\n";
  }
};

/// Which drop a figure shows: run, time or number, seeds, labels and robot, for its caption.
std::string drop_text(const experiments::Experiment& experiment,
                      const experiments::DropChoice& choice) {
  const std::string when = choice.at ? fmt::format("around {:.6g} s", *choice.at)
                                     : fmt::format("drop {} of {} (from 0)", choice.drop,
                                                   experiments::to_text(choice.wheels));
  return fmt::format("Test run {}, {}, experiment seed {}, noise seed {}; {}{}.", choice.run, when,
                     experiment.seed, choice.seed, experiments::labels_text(experiment),
                     experiments::setup_caption(experiment));
}

/// "Not shown: NMN, Free fall."; empty where all of the experiment's estimators are shown.
std::string left_out_text(const experiments::Experiment& experiment,
                          const std::vector<std::string>& shown) {
  std::vector<std::string> titles;
  for (const std::string& name : experiment.estimators) {
    if (std::find(shown.begin(), shown.end(), name) != shown.end()) continue;
    titles.push_back(experiments::estimator_title_in(experiment, name));
  }
  return titles.empty() ? "" : fmt::format(" Not shown: {}.", fmt::join(titles, ", "));
}

void draw_detail(const experiments::ExperimentResult& result, const std::string& simulator) {
  const experiments::Experiment& experiment = result.experiment;
  const experiments::DetailConfig& config = *experiment.detail;
  const experiments::FinishedRun& run = chosen_run(result, simulator, config.choice.run, "detail");
  const logs::Recording recording =
      chosen_recording(result, simulator, config.choice.run, "detail");
  logs::Recording reported = recording;
  const experiments::RunSignals signals = experiments::reported_signals(
      experiments::profile_of(experiments::read_sensors(experiment, result.directory.path()),
                              experiment.sensors),
      experiment, *scenarios::CompiledScenes().as_described(run.plan.scenario), reported);
  const experiments::DropDetail detail =
      experiments::drop_detail(experiment, config, recording, signals, result.models);
  const FigureText text{
      fmt::format("One {} in detail: {}, {}", config.choice.at ? "moment" : "drop", experiment.name,
                  simulators::simulator_title(simulator)),
      fmt::format(
          "{} Left wheel and leg. Spectra, power and median frequency are computed over the "
          "{:.0f} ms before each instant. They, the switch probabilities and the torque "
          "evidence come from the models of {}. Dashed verticals: takeoffs and landings of "
          "the left wheel.{}",
          drop_text(experiment, config.choice), 1e3 / detail.bin_width, detail.transition_of,
          left_out_text(experiment, config.estimators)),
      fmt::format(
          "Rows of curves over the time around one drop, with a column for each of {} noise "
          "settings: height of the base, knee and wheel torque with and without noise, evidence of "
          "these torques for contact, contact probability of {}, spectrograms of the true and of "
          "the noisy vertical acceleration with their power and median frequency, and the "
          "probabilities of a takeoff and a landing. The time in true contact is tinted.",
          config.noise.size(), fmt::join(config.estimators, ", "))};
  draw_drop_detail(detail, experiment.estimators, text, figure_file(result, "detail_" + simulator));
}

}  // namespace

std::string spectrum_text(const experiments::SpectrumTrace& trace, double bin_width) {
  constexpr double floor = 1e-6;  // −60 dB, drawn as zero
  std::string text = fmt::format(
      "# dB of m2/s4; row i: the bin of {} Hz nearest to 2^({} + i/{}) Hz; columns: times\n",
      bin_width, lowest_octave, rows_per_octave);
  const int rows = static_cast<int>((highest_octave - lowest_octave) * rows_per_octave);
  for (int row = 0; row <= rows; ++row) {
    const double frequency = std::exp2(lowest_octave + row / rows_per_octave);
    const auto nearest = static_cast<std::size_t>(std::llround(frequency / bin_width));
    for (const auto& column : trace.spectrum) {
      const double value = column[std::min(nearest, column.size() - 1)];
      fmt::format_to(std::back_inserter(text), "{:.2f}\t",
                     10.0 * std::log10(std::max(floor, value)));
    }
    text.back() = '\n';
  }
  return text;
}

Figure draw_drop_detail(const experiments::DropDetail& detail,
                        const std::vector<std::string>& estimators, const FigureText& text,
                        const FigureFile& target) {
  const std::string name = target.name();
  PanelGrid::Layout layout;
  layout.at = detail.at;
  constexpr std::array heights = {84.0, 118.0, 118.0, 118.0, 156.0, 150.0, 150.0, 130.0};
  const bool has_evidence = std::ranges::any_of(detail.noisy, [](const auto& drop) {
    return std::ranges::any_of(drop.torque_evidence, [](double v) { return std::isfinite(v); });
  });
  std::map<Row, std::size_t> rows;
  for (std::size_t row = 0; row < heights.size(); ++row) {
    if (row == evidence && !has_evidence) continue;  // no Bayes filter takes part
    rows.emplace(static_cast<Row>(row), rows.size());
    layout.row_heights.push_back(heights[row]);
  }
  std::vector<std::string> names;
  for (const auto& trace : detail.noisy.front().beliefs) names.push_back(trace.title);
  layout.right = std::max(300.0, 70.0 + 1.1 * text_width(names));  // letters of 11 pt
  for (const auto& [row, place] : rows) {
    layout.keys.push_back(row == belief                               ? names.size()
                          : row == wheel || row == noisy_spectrum     ? 0
                          : row == true_spectrum || row == transition ? 3
                          : row == evidence                           ? 1
                                                                      : 2);
  }
  for (const experiments::NoisyDrop& drop : detail.noisy) {
    layout.columns.push_back(fmt::format("noise: torques {} N·m, accelerometer {} m/s²",
                                         drop.noise.torque, drop.noise.accelerometer));
  }
  const PanelGrid grid(target, layout, text);
  std::vector<PlotData> data = {
      {name + "_spectrum_0.dat", spectrum_text(detail.spectrum, detail.bin_width)}};
  std::string commands = grid.begin(1e3 * detail.time.front(), 1e3 * detail.time.back());
  for (std::size_t i = 0; i < detail.noisy.size(); ++i) {
    const PlotColumns columns = detail_columns(detail, detail.noisy[i]);
    commands += DetailColumn{detail, grid, i, columns, name, estimators, rows}.commands();
    data.push_back({fmt::format("{}_{}.dat", name, i + 1), columns.text()});
    data.push_back({fmt::format("{}_spectrum_{}.dat", name, i + 1),
                    spectrum_text(detail.noisy[i].spectrum, detail.bin_width)});
  }
  return grid.draw(commands, data);
}

void draw_drop_details(const experiments::ExperimentResult& result, const std::atomic<bool>* stop) {
  if (!result.experiment.detail) return;
  for (const std::string& simulator : result.experiment.simulators) {
    stop_if_asked(stop);
    draw_if_possible([&] { draw_detail(result, simulator); });
  }
}

}  // namespace touchdown::render
