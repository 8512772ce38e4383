#include "render/curves/reliability_figure.hpp"

#include <iterator>

#include <fmt/format.h>

#include "core/error.hpp"
#include "render/gnuplot/frame.hpp"
#include "render/gnuplot/text.hpp"

namespace touchdown::render {
namespace {

constexpr double side = 360.0, counts_height = 96.0, gap = 84.0, left_margin = 70.0, key = 240.0;
constexpr double counts_top = side + 62.0;

/// One block (gnuplot's `index`) per panel and curve: what was said, what was true with its
/// interval, how often.
std::string data_of(const ReliabilityFigure& figure) {
  std::string text = "#bin_centre\tmean_probability\tcontact_frequency\tlow\thigh\tsteps\n";
  for (const ReliabilityPanel& panel : figure.panels) {
    for (const ReliabilityCurve& curve : panel.curves) {
      for (std::size_t b = 0; b < scoring::Calibration::bins; ++b) {
        const scoring::Calibration::Bin& bin = curve.calibration.bin[b];
        const Interval& frequency = curve.contact_frequency[b];
        fmt::format_to(std::back_inserter(text), "{}\t{}\t{}\t{}\t{}\t{}\n",
                       (static_cast<double>(b) + 0.5) / scoring::Calibration::bins,
                       number(bin.mean_probability()), number(frequency.estimate),
                       number(frequency.low), number(frequency.high),
                       bin.points > 0 ? std::to_string(bin.points) : "NaN");
      }
      text += "\n\n";
    }
  }
  return text;
}

/// One plot of all curves of a panel.
std::string plot(const ReliabilityPanel& panel, const std::string& file, std::size_t first_block,
                 const char* columns, const char* with, bool named) {
  std::string text;
  for (std::size_t c = 0; c < panel.curves.size(); ++c) {
    text +=
        fmt::format(", \\\n     {} index {} using {} with {} lt {} title {}", file, first_block + c,
                    columns, with, c + 1, gnuplot_text(named ? panel.curves[c].name : ""));
  }
  return text;
}

std::string described(const ReliabilityFigure& figure) {
  std::string text = "How often there was contact against the probability that was stated.";
  for (const ReliabilityPanel& panel : figure.panels) {
    text += fmt::format(" {}: Brier score", panel.title);
    for (std::size_t c = 0; c < panel.curves.size(); ++c) {
      text += fmt::format("{} {:.3f} ({})", c > 0 ? "," : "", panel.curves[c].calibration.brier(),
                          panel.curves[c].name);
    }
    text += '.';
  }
  return text;
}

}  // namespace

Figure draw_reliability_figure(const ReliabilityFigure& figure, const std::filesystem::path& stem) {
  if (figure.panels.empty() || figure.panels.front().curves.empty()) {
    throw InputError("a reliability figure without curves");
  }
  const auto panels = static_cast<double>(figure.panels.size());
  const FigureFrame frame(figure.title, figure.caption,
                          left_margin + panels * side + (panels - 1.0) * gap + key,
                          counts_top + counts_height + 58.0);
  const std::string file = gnuplot_text(stem.filename().string() + ".dat");
  std::string commands = "set xrange [0:1]\nset bars 0\n";
  std::size_t block = 0;
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const ReliabilityPanel& panel = figure.panels[i];
    const double left = left_margin + static_cast<double>(i) * (side + gap);
    commands += frame.panel(left, 26.0, side, side);
    commands += fmt::format(
        "set title {} offset 0,-0.6\nset yrange [0:1]\nset ytics 0.2\nset xtics 0.2\n"
        "set format y '%g'\nset format x '%g'\nunset logscale y\n"
        "unset xlabel\nset ylabel {}\n"
        "set arrow from 0,0 to 1,1 nohead back lc rgb '#9aa1a8' lw 1 dt 1\n",
        gnuplot_text(panel.title), i == 0 ? "'share of steps in contact'" : "''");
    commands += i == 0
                    ? fmt::format("set key at screen {}, screen {} left top Left reverse\n",
                                  1.0 - (key - 22.0) / frame.width(), 1.0 - 66.0 / frame.height())
                    : "unset key\n";
    commands += "plot 2 lc rgb '#ffffff'" +
                plot(panel, file, block, "2:3:4:5", "yerrorbars lw 0.9 dt 1 pt 0", false) +
                plot(panel, file, block, "2:3", "linespoints", i == 0) + '\n' +
                FigureFrame::end_panel();
    commands += frame.panel(left, counts_top, side, counts_height);
    commands += fmt::format(
        "unset title\nunset key\nset logscale y\nset yrange [1:*]\nset ytics autofreq 100\n"
        "set format y '%.0s%c'\nset xlabel 'stated probability of contact'\nset ylabel {}\n",
        i == 0 ? "'steps'" : "''");
    commands += "plot 0.1 lc rgb '#ffffff'" +
                plot(panel, file, block, "1:6", "linespoints ps 0.4", false) + '\n';
    block += panel.curves.size();
  }
  return frame.draw(stem, commands, data_of(figure), described(figure));
}

}  // namespace touchdown::render
