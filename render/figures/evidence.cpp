#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "estimator/evidence/channels.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/estimators/entries.hpp"
#include "experiments/results/captions.hpp"
#include "render/figures/chosen_run.hpp"
#include "render/figures/figures.hpp"
#include "render/gnuplot/frame.hpp"
#include "render/palette.hpp"
#include "simulators/registry.hpp"

namespace touchdown::render {
namespace {

constexpr double evidence_width = 232.0, evidence_height = 168.0, evidence_left = 76.0;
constexpr double evidence_gap_x = 26.0, evidence_gap_y = 82.0;

/// One panel: a range of inputs, and the axis that they share.
struct EvidencePanel {
  std::string title;
  std::string unit;
  std::size_t first = 0;  ///< of its inputs
  std::size_t count = 1;
  double softsign_scale = 0.0;  ///< of its compression, in its unit; 0: a logarithmic axis
};

std::vector<EvidencePanel> evidence_panels(const EvidenceModel& model) {
  std::vector<EvidencePanel> all;
  std::size_t first = 0;
  const auto add = [&](const EvidenceChannel& channel) {
    all.push_back({channel.title, channel.unit, first, decision_scales,
                   static_cast<double>(channel.softsign_scale)});
    first += decision_scales;
  };
  for (const EvidenceChannel& channel : evidence_channels) add(channel);
  all.push_back({"torque noise", "N·m", first++, 1, 0.0});
  all.push_back({"acceleration noise", "m/s²", first++, 1, 0.0});
  if (model.servo_curve.empty()) return all;
  for (const EvidenceChannel& channel : servo_load_channels) add(channel);
  return all;
}

/// The range of a panel's inputs in the training data.
std::array<double, 2> evidence_ends(const EvidenceModel& model, const EvidencePanel& panel) {
  std::array<double, 2> ends = {std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::lowest()};
  for (std::size_t i = panel.first; i < panel.first + panel.count; ++i) {
    ends[0] = std::min(ends[0], static_cast<double>(seen_by(model, i)[0]));
    ends[1] = std::max(ends[1], static_cast<double>(seen_by(model, i)[1]));
  }
  // The axis of a constant channel still needs a width.
  if (!(ends[1] - ends[0] > 0.01)) ends = {ends[0] - 0.5, ends[1] + 0.5};
  if (panel.softsign_scale > 0.0) {  // full saturation stands for an infinite value
    constexpr double furthest = 0.995 * static_cast<double>(saturation);
    ends = {std::max(ends[0], -furthest), std::min(ends[1], furthest)};
  }
  return ends;
}

/// The panel's data block: compressed input, value, a column of nats for each time scale.
std::string evidence_block(const EvidenceModel& model, const EvidencePanel& panel) {
  constexpr int points = 240;
  const auto [low, high] = evidence_ends(model, panel);
  std::string text = "#compressed\tvalue";
  for (std::size_t k = 0; k < panel.count; ++k) {
    text += panel.count > 1 ? fmt::format("\tnats_{}_ms", 1U << k) : "\tnats";
  }
  for (int point = 0; point <= points; ++point) {
    const double x = low + (high - low) * point / points;
    const double value =
        panel.softsign_scale > 0.0 ? uncompressed(x, panel.softsign_scale) : std::exp(x);
    fmt::format_to(std::back_inserter(text), "\n{:.5g}\t{:.5g}", x, value);
    for (std::size_t i = panel.first; i < panel.first + panel.count; ++i) {
      const auto at = static_cast<float>(x);
      const bool is_seen = at >= seen_by(model, i)[0] && at <= seen_by(model, i)[1];
      text += is_seen ? fmt::format("\t{:.4g}", evidence_at(curve_of(model, i), at)) : "\tNaN";
    }
  }
  return text + "\n\n\n";
}

/// The largest absolute contribution of a panel's inputs over the training data's range (nats).
double largest_contribution(const EvidenceModel& model, const EvidencePanel& panel) {
  double most = 0.0;
  for (std::size_t i = panel.first; i < panel.first + panel.count; ++i) {
    const float step = (seen_by(model, i)[1] - seen_by(model, i)[0]) / 240.0F;
    for (int point = 0; point <= 240; ++point) {
      const float x = seen_by(model, i)[0] + step * static_cast<float>(point);
      most = std::max(most, std::abs(static_cast<double>(evidence_at(curve_of(model, i), x))));
    }
  }
  return most;
}

/// The colour of a time scale: the fastest is the darkest.
std::string scale_colour(std::size_t scale, std::size_t count) {
  if (count == 1) return "#22262b";
  return fmt::format("#{:06x}", viridis[scale]);
}

std::string evidence_ticks(const EvidencePanel& panel, double low, double high) {
  std::string text;
  for (const CompressedTick& tick : compressed_ticks(low, high, panel.softsign_scale)) {
    const std::string sign = tick.value < 0.0 ? "−" : "";
    fmt::format_to(std::back_inserter(text), "{}'{}{:g}' {:.5g}", text.empty() ? "" : ", ", sign,
                   std::abs(tick.value), tick.place);
  }
  return text;
}

/// The panel's curves. In the first panel, their titles are the legend of all.
std::string evidence_plot(const EvidencePanel& panel, const std::string& file, std::size_t block) {
  std::string text = "plot 0 with lines lc rgb '#9aa1a9' lw 1 dt 1 notitle";
  for (std::size_t k = 0; k < panel.count; ++k) {
    fmt::format_to(
        std::back_inserter(text),
        ", \\\n     {} index {} using 1:{} with lines lc rgb '{}' lw 1.7 dt 1 title '{} ms'", file,
        block, k + 3, scale_colour(k, panel.count), 1U << k);
  }
  return text + "\n";
}

std::string evidence_described(const EvidenceFigure& figure,
                               const std::vector<EvidencePanel>& all) {
  std::string text =
      "Evidence for contact as a function of each input, at eight time scales. Largest absolute "
      "contributions, in nats:";
  for (const EvidencePanel& panel : all) {
    fmt::format_to(std::back_inserter(text), " {} {:.2f},", panel.title,
                   largest_contribution(figure.model, panel));
  }
  text.back() = '.';
  return text;
}

/// The figures of all estimators that have evidence curves, with the estimators' names.
std::vector<std::pair<std::string, EvidenceFigure>> evidence_figures(
    const experiments::ExperimentResult& result, const std::string& simulator) {
  std::vector<std::pair<std::string, EvidenceFigure>> figures;
  const experiments::Experiment& experiment = result.experiment;
  const auto models = result.models.find(simulator);
  if (models == result.models.end()) return figures;
  for (const std::string& estimator : experiment.estimators) {
    const auto fitted = models->second.find(estimator);
    if (fitted == models->second.end()) continue;
    const std::optional<EvidenceCurveSets> sets = experiments::evidence_in(fitted->second);
    if (!sets) continue;
    const auto add = [&](const std::string& name, const std::string& steps,
                         const EvidenceModel& model) {
      figures.emplace_back(
          name,
          EvidenceFigure{
              fmt::format("Evidence of each input for a wheel's contact{}: {}, {}, {}", steps,
                          experiments::estimator_entry(experiment, estimator).title,
                          experiment.name, simulators::simulator_title(simulator)),
              model,
              fmt::format(
                  "Fitted to {}{}, seed {}; {}{}. The curves form an additive model (GAM) of the "
                  "log odds of contact: values above 0 are evidence for contact, values below 0 "
                  "against it. The estimator adds the values of all curves. Each curve averages 0 "
                  "over the training data and covers all but two in a thousand of its rows. Axes "
                  "are compressed as the estimator's inputs are; those of noise levels are "
                  "logarithmic.",
                  experiments::plural(fitted_runs(result, simulator), "run"),
                  experiment.training_segments.empty() ? "" : " and segments of others",
                  experiment.seed, experiments::labels_text(experiment),
                  experiments::setup_caption(experiment))});
    };
    add(estimator, sets->without_targets ? " at steps with targets" : "", sets->usual);
    if (!sets->without_targets) continue;
    add(estimator + "_without_targets", " at steps without targets", *sets->without_targets);
  }
  return figures;
}

}  // namespace

std::vector<CompressedTick> compressed_ticks(double low, double high, double softsign_scale) {
  constexpr double apart = 0.12;  // of the axis
  const double span = high - low;
  std::vector<CompressedTick> chosen;
  const auto offer = [&](double value) {
    if (softsign_scale <= 0.0 && !(value > 0.0)) return;
    const double place = softsign_scale > 0.0 ? compressed(value, softsign_scale) : std::log(value);
    const bool is_inside = place >= low && place <= high;
    const bool is_apart = std::ranges::all_of(
        chosen, [&](const auto& other) { return std::abs(other.place - place) >= apart * span; });
    if (is_inside && is_apart) chosen.push_back({value, place});
  };
  offer(0.0);
  for (const double digit : {1.0, 3.0}) {
    for (int power = 4; power >= -3; --power) {
      const double value = digit * std::pow(10.0, power);
      offer(value);
      offer(-value);
    }
  }
  std::ranges::sort(chosen, [](const auto& a, const auto& b) { return a.place < b.place; });
  return chosen;
}

Figure draw_evidence_figure(const EvidenceFigure& figure, const FigureFile& target) {
  const std::vector<EvidencePanel> all = evidence_panels(figure.model);
  const PanelColumns across =
      columns_in(target.room(), evidence_left + 22.0, {4, evidence_width, evidence_gap_x});
  const std::size_t row_count = (all.size() + across.count - 1) / across.count;
  const auto rows = static_cast<double>(row_count);
  const bool is_narrow = across.count < 4;
  const double evidence_top = is_narrow ? 112.0 : 66.0;  // px; the key is above
  const FigureFrame frame(
      target, {figure.title, figure.caption, evidence_described(figure, all)},
      evidence_left + across.left(across.count - 1) + across.width + 22.0,
      evidence_top + rows * evidence_height + (rows - 1.0) * evidence_gap_y + 56.0);
  double height = 0.1;
  for (const EvidencePanel& panel : all) {
    height = std::max(height, largest_contribution(figure.model, panel));
  }
  height *= 1.05;
  const std::string file = gnuplot_file(target.name() + ".dat");
  std::string commands = fmt::format(
      "unset key\nset border 3\nset tics nomirror out scale 0.5\nset grid xtics ytics\n"
      "set yrange [{:.4g}:{:.4g}]\nset ytics {}\n",
      -height, height, tick_step(2.0 * height, 6.0));
  std::string data;
  for (std::size_t p = 0; p < all.size(); ++p) {
    const EvidencePanel& panel = all[p];
    const auto [low, high] = evidence_ends(figure.model, panel);
    const std::size_t row = p / across.count;
    const std::size_t column = p % across.count;
    const double left = evidence_left + across.left(column);
    const double top = evidence_top + static_cast<double>(row) * (evidence_height + evidence_gap_y);
    commands += frame.panel(left, top, across.width, evidence_height);
    commands += p > 0 ? "unset key\n"
                      : frame.key(evidence_left, 0.0) +
                            fmt::format("set key maxrows {} title 'time scale' samplen 1\n",
                                        is_narrow ? 2 : 1);
    commands += fmt::format(
        "set title {} offset 0,-0.6\nset xlabel {} offset 0,0.5\nset xrange [{:.5g}:{:.5g}]\n"
        "set xtics ({})\nset ylabel '{}' offset 0,0\nset format y '{}'\n",
        gnuplot_text(panel.title), gnuplot_text(panel.unit), low, high,
        evidence_ticks(panel, low, high), column == 0 ? "evidence for contact (nats)" : "",
        column == 0 ? "%g" : "");
    commands += evidence_plot(panel, file, p) + FigureFrame::end_panel();
    data += evidence_block(figure.model, panel);
  }
  return frame.draw(commands, data);
}

void draw_evidence(const experiments::ExperimentResult& result, const std::atomic<bool>* stop) {
  for (const std::string& simulator : result.experiment.simulators) {
    for (const auto& [estimator, evidence] : evidence_figures(result, simulator)) {
      stop_if_asked(stop);
      draw_evidence_figure(evidence,
                           figure_file(result, fmt::format("{}_{}", estimator, simulator)));
    }
  }
}

}  // namespace touchdown::render
