#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "experiments/results/captions.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/figures/figures.hpp"
#include "render/gnuplot/frame.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {
namespace {

enum PosteriorRow : std::size_t {
  wheel_row,
  label_row,
  likelihood_row,
  error_row,
  posterior_row,
  belief_row
};

/// Log likelihoods are clipped at this distance below the most likely phase (nats).
constexpr double faintest = -8.0;

/// The short and the full name of a phase, and its colour (0xRRGGBB).
struct PhaseStyle {
  const char* tick;
  const char* title;
  unsigned colour;
};

/// By `Phase`. Grey on the ground, orange towards a takeoff, blue in the air, green after a
/// landing; darker the nearer the event.
constexpr std::array<PhaseStyle, phase_count> styles = {{{"R", "rolling", 0xd4d7da},
                                                         {"U1", "unloading, 150–60 ms", 0xfde0b0},
                                                         {"U2", "unloading, 60–20 ms", 0xf2ae3d},
                                                         {"U3", "unloading, 20–0 ms", 0xb86b00},
                                                         {"F", "flight", 0x0a5a9c},
                                                         {"I1", "impact, 0–15 ms", 0x00563f},
                                                         {"I2", "impact, 15–60 ms", 0x2fa884},
                                                         {"I3", "impact, 60–150 ms", 0xb5dfd0},
                                                         {"H", "held", 0x8d3b72},
                                                         {"C", "carried", 0xdba3c4},
                                                         {"LO", "left wheel only", 0x56b4e9},
                                                         {"RO", "right wheel only", 0xa9d8f3}}};

PlotColumns columns_of(const experiments::DropPosterior& drop) {
  PlotColumns columns;
  columns.add("time_ms", in_ms(drop.time));
  for (std::size_t phase = 0; phase < phase_count; ++phase) {
    std::vector<double> values;
    for (const PhaseProbabilities& p : drop.phases) values.push_back(p[phase]);
    columns.add("p_" + std::string(phase_names[phase]), std::move(values));
  }
  std::vector<double> truth;
  for (const Phase phase : drop.truth) truth.push_back(static_cast<double>(index(phase)));
  columns.add("true_phase", std::move(truth));
  const auto add_error_column = [&](const char* name,
                                    double experiments::LogLikelihoodError::*term) {
    std::vector<double> values;
    for (const experiments::LogLikelihoodError& error : drop.log_likelihood_error) {
      values.push_back(error.*term);
    }
    columns.add(name, std::move(values));
  };
  add_error_column("error_by_left_leg", &experiments::LogLikelihoodError::left);
  add_error_column("error_by_right_leg", &experiments::LogLikelihoodError::right);
  add_error_column("error_by_acceleration", &experiments::LogLikelihoodError::acceleration);
  add_error_column("error_by_memory", &experiments::LogLikelihoodError::memory);
  columns.add("p_left_wheel", drop.p_contact[0]);
  columns.add("p_right_wheel", drop.p_contact[1]);
  return columns;
}

/// Runs of equal values as rectangles between `low` and `high`: x0, x1, y0, y1, colour.
template <typename T, typename Colour>
std::string rectangles(const std::vector<double>& time, const std::vector<T>& values, double low,
                       double high, const Colour& colour) {
  std::string text;
  for (std::size_t begin = 0; begin < values.size();) {
    std::size_t end = begin + 1;
    while (end < values.size() && values[end] == values[begin]) ++end;
    fmt::format_to(std::back_inserter(text), "{}\t{}\t{}\t{}\t{}\n", time[begin],
                   end < time.size() ? time[end] : time.back(), low, high, colour(values[begin]));
    begin = end;
  }
  return text;
}

/// The data block of the wheels, then that of the phases.
std::string truth_text(const experiments::DropPosterior& drop) {
  const std::vector<double> time = in_ms(drop.time);
  const auto contact_colour = [](std::uint8_t contact) {
    return contact != 0 ? 0x8fcaa0U : 0xffffffU;
  };
  return "# from_ms\tto_ms\tlow\thigh\tcolour\n" +
         rectangles(time, drop.contact[0], 1.1, 1.9, contact_colour) +
         rectangles(time, drop.contact[1], 0.1, 0.9, contact_colour) + "\n\n" +
         rectangles(time, drop.truth, 0.0, 1.0,
                    [](Phase phase) { return styles[index(phase)].colour; });
}

/// Log likelihoods relative to the most likely phase (nats). Rows: phases; columns: times.
std::string likelihood_text(const experiments::DropPosterior& drop) {
  std::string text = "# log likelihood below the likeliest phase; row i: phase i; columns: times\n";
  std::vector<double> largest;
  for (const experiments::PhaseEvidence& step : drop.evidence) {
    double most = step.sum(Phase::rolling);
    for (std::size_t i = 1; i < phase_count; ++i) {
      most = std::max(most, step.sum(static_cast<Phase>(i)));
    }
    largest.push_back(most);
  }
  for (std::size_t i = 0; i < phase_count; ++i) {
    for (std::size_t k = 0; k < drop.evidence.size(); ++k) {
      const double below = drop.evidence[k].sum(static_cast<Phase>(i)) - largest[k];
      fmt::format_to(std::back_inserter(text), "{:.3f}\t", std::max(faintest, below));
    }
    text.back() = '\n';
  }
  return text;
}

/// The largest absolute log-likelihood error of any term, but at least 1 (nats).
double largest_error_of(const experiments::DropPosterior& drop) {
  double most = 1.0;
  for (const experiments::LogLikelihoodError& error : drop.log_likelihood_error) {
    for (const double value : {error.left, error.right, error.acceleration, error.memory}) {
      most = std::max(most, std::abs(value));
    }
  }
  return most;
}

std::string boxes(const std::string& file, int block) {
  return fmt::format(
      "'{}' index {} using (($1+$2)/2):(($3+$4)/2):1:2:3:4:5 with boxxyerror "
      "linecolor rgb variable fillstyle solid noborder notitle",
      file, block);
}

std::string column_commands(const experiments::DropPosterior& drop, const PanelGrid& grid,
                            std::size_t column, bool last, double largest_error,
                            const PlotColumns& columns, const std::string& name) {
  const std::string data = fmt::format("{}_{}.dat", name, column + 1);
  const std::string truth = fmt::format("{}_truth_{}.dat", name, column + 1);
  const auto panel = [&](PosteriorRow row, std::string_view text) {
    return grid.panel(row, column, text) + (last ? grid.key(row) : "");
  };
  std::vector<bool> any;
  for (std::size_t k = 0; k < drop.time.size(); ++k) {
    any.push_back(drop.contact[0][k] != 0 || drop.contact[1][k] != 0);
  }
  std::string text = contact_bands(in_ms(drop.time), any) + "unset object\n";
  text += panel(wheel_row, "truth");
  text += fmt::format(
      "set yrange [0:2]\nset ytics ({} 1.5, {} 0.5) scale 0\nunset grid\n"
      "plot {}, NaN with boxes fillcolor rgb '#8fcaa0' title 'wheel in contact'\n",
      column == 0 ? "'left'" : "''", column == 0 ? "'right'" : "''", boxes(truth, 0));
  text += panel(label_row, "");
  text += fmt::format("set yrange [0:1]\nset ytics ({} 0.5) scale 0\nplot {}\n",
                      column == 0 ? "'phase'" : "''", boxes(truth, 1));
  text += panel(likelihood_row, "likelihood");
  text += fmt::format("set yrange [-0.5:{}]\nset cbrange [{}:0]\nset ytics (",
                      static_cast<double>(phase_count) - 0.5, faintest);
  for (std::size_t phase = 0; phase < phase_count; ++phase) {
    text += fmt::format("'{}' {}{}", column == 0 ? styles[phase].tick : "", phase,
                        phase + 1 < phase_count ? ", " : ") scale 0 font ',10'\n");
  }
  text += last ? grid.colour_bar(likelihood_row, 14.0, 16.0) +
                     "set cblabel 'nats below the most likely' font ',11' offset 1.2,0\n"
                     "set cbtics 2 font ',11'\n"
               : "unset colorbox\n";
  const double step = drop.time.size() > 1 ? 1e3 * (drop.time[1] - drop.time[0]) : 1.0;
  text += fmt::format(
      "plot '{}_likelihood_{}.dat' matrix using ({}+{}*$1):2:3 with image notitle, "
      "'{}' using 1:{} with steps lc rgb 'black' lw 2 dt 1 notitle\n",
      name, column + 1, 1e3 * drop.time.front(), step, data, columns.number_of("true_phase"));
  text += panel(error_row, "log-likelihood\nerror (nats)");
  text += fmt::format(
      "set yrange [-{0}:{0}]\nset ytics autofreq scale 0.5 norangelimit font ',13'\n"
      "set grid\nplot 0 with lines lc rgb '#8a9299' lw 1 dt 1 notitle",
      1.05 * largest_error);
  const auto add_error = [&](const char* key, const char* style, const char* title) {
    text += fmt::format(", '{}' using 1:{} with lines {} dt 1 title {}", data,
                        columns.number_of(key), style, gnuplot_text(title));
  };
  add_error("error_by_left_leg", "lt 6 lw 2", "left leg's torques");
  add_error("error_by_right_leg", "lt 2 lw 2", "right leg's torques");
  add_error("error_by_acceleration", "lt 3 lw 2", "acceleration");
  add_error("error_by_memory", "lc rgb '#101418' lw 2", "memory");
  text += "\n" + panel(posterior_row, "P(phase)");
  text += "set yrange [0:1]\nset ytics 0,0.5,1 scale 0.5\nset grid\nplot ";
  // Drawn from the full sum downwards, each over the previous one: neighbours have no seams.
  for (std::size_t phase = phase_count; phase-- > 0;) {
    text += fmt::format(
        "'{}' using 1:(sum [c=2:{}] column(c)) with filledcurves y1=0 fillcolor rgb "
        "'#{:06x}' title '{}'{}",
        data, phase + 2, styles[phase].colour, styles[phase].title, phase > 0 ? ", " : "\n");
  }
  text += panel(belief_row, "P(contact)");
  text += fmt::format(
      "set yrange [-0.04:1.04]\nplot '{0}' using 1:{1} with lines lt 6 lw 4.5 dt 1 title 'left "
      "wheel', "
      "'{0}' using 1:{2} with lines lt 2 lw 1.6 dt 1 title 'right wheel'\n",
      data, columns.number_of("p_left_wheel"), columns.number_of("p_right_wheel"));
  return text;
}

FigureText posterior_text(const experiments::Experiment& experiment,
                          const experiments::PosteriorConfig& config) {
  return {
      fmt::format("The phase filter through one {}: {}", config.choice.at ? "moment" : "drop",
                  experiment.name),
      fmt::format(
          "{} Noise: {} N·m on torques, {} m/s² on the accelerometer. True phases look "
          "ahead: an unloading is named after the takeoff that follows. Likelihoods are "
          "those of one step, tempered as in the filter; black: the true phase. "
          "Log-likelihood error: where the most probable phase is wrong about a wheel, its "
          "log-likelihood ratio to the true phase, by source; memory is the previous belief. "
          "Dashed verticals: the last wheel leaves the ground, the first one lands.",
          drop_text(experiment, config.choice), config.noise.torque, config.noise.accelerometer),
      "Over the time around one drop, for each engine: true contact of both wheels, the true "
      "phase, the likelihood of every phase, the log-likelihood error by source, the stacked "
      "probabilities "
      "of all phases, and the contact probability of both wheels."};
}

}  // namespace

Figure draw_phase_posterior(const std::vector<experiments::DropPosterior>& drops,
                            const FigureText& text, const FigureFile& target) {
  const std::string name = target.name();
  PanelGrid::Layout layout;
  layout.columns.clear();
  layout.at = drops.front().at;
  layout.row_heights = {52.0, 26.0, 216.0, 120.0, 250.0, 120.0};
  layout.keys = {1, 0, 0, 4, phase_count, 2};
  layout.narrow_right = 110.0;  // the colour bar of the likelihoods
  double from = 0.0, to = 0.0, largest_error = 0.0;
  for (const experiments::DropPosterior& drop : drops) {
    layout.columns.push_back(simulators::simulator_title(drop.simulator));
    from = std::min(from, 1e3 * drop.time.front());
    to = std::max(to, 1e3 * drop.time.back());
    largest_error = std::max(largest_error, largest_error_of(drop));
  }
  const PanelGrid grid(target, layout, text);
  std::vector<PlotData> data;
  std::string commands = grid.begin(from, to);
  for (std::size_t i = 0; i < drops.size(); ++i) {
    const PlotColumns columns = columns_of(drops[i]);
    commands +=
        column_commands(drops[i], grid, i, i + 1 == drops.size(), largest_error, columns, name);
    data.push_back({fmt::format("{}_{}.dat", name, i + 1), columns.text()});
    data.push_back({fmt::format("{}_truth_{}.dat", name, i + 1), truth_text(drops[i])});
    data.push_back({fmt::format("{}_likelihood_{}.dat", name, i + 1), likelihood_text(drops[i])});
  }
  return grid.draw(commands, data);
}

void draw_phase_posteriors(const experiments::ExperimentResult& result,
                           const std::atomic<bool>* stop) {
  const experiments::Experiment& experiment = result.experiment;
  if (!experiment.posterior) return;
  const experiments::PosteriorConfig& config = *experiment.posterior;
  std::vector<experiments::DropPosterior> drops;
  for (const std::string& simulator : experiment.simulators) {
    stop_if_asked(stop);
    draw_if_possible([&] {
      const experiments::Rollout& run =
          chosen_run(result, simulator, config.choice.run, "posterior");
      drops.push_back(experiments::drop_posterior(experiment, config, run.signals, result.models));
    });
  }
  if (drops.empty()) return;
  draw_phase_posterior(drops, posterior_text(experiment, config),
                       figure_file(result, "phase_posterior"));
}

}  // namespace touchdown::render
