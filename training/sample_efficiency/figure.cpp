#include "training/sample_efficiency/figure.hpp"

#include <fmt/format.h>

#include "render/gnuplot/process.hpp"

namespace touchdown::training {

namespace {

constexpr const char* head = R"gnuplot(# gnuplot sample_efficiency.gp
set terminal pngcairo size 1600,{height} font "DejaVu Sans,18" linewidth 2
set output "sample_efficiency.png"
set datafile separator comma
set datafile missing NaN
data = "../tables/sample_efficiency.csv"
rows(engine, method, column) = strcol(1) eq engine && strcol(2) eq method ? column : NaN
set multiplot layout {rows},2
set logscale x
set grid lc rgb "#dddddd"
set key outside bottom center horizontal
set xlabel "Labelled data (s)"
set yrange [*:1]
)gnuplot";

constexpr const char* panel = R"gnuplot(
set title "{engine}"
set ylabel "{label}"
plot data using 3:(rows("{engine}", "{filter}", ${column})) with linespoints pt 7 lc rgb "#4477aa" title "{filter}", \
     data using 3:(rows("{engine}", "NMN", ${column})) with linespoints pt 5 lc rgb "#cc6677" title "NMN"
)gnuplot";

}  // namespace

std::filesystem::path draw_sample_efficiency(const std::filesystem::path& run_directory,
                                             const std::vector<std::string>& simulators,
                                             const std::string& filter_title) {
  std::string text = fmt::format(head, fmt::arg("height", 550 * simulators.size()),
                                 fmt::arg("rows", simulators.size()));
  for (const std::string& engine : simulators) {
    for (const auto& [label, column] : {std::pair("Success rate", 4), {"No-contact recall", 6}}) {
      text += fmt::format(panel, fmt::arg("engine", engine), fmt::arg("label", label),
                          fmt::arg("filter", filter_title), fmt::arg("column", column));
    }
  }
  return render::try_gnuplot(run_directory / "figures" / "sample_efficiency.gp",
                             text + "unset multiplot\n");
}

}  // namespace touchdown::training
