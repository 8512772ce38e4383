#include "training/loss_figure.hpp"

#include <string>

#include <fmt/format.h>

#include "render/gnuplot/process.hpp"

namespace touchdown::training {

namespace {

constexpr const char* script_text = R"gnuplot(# gnuplot training.gp
set terminal pngcairo size 1200,800 font "DejaVu Sans,20" linewidth 2
set output "training.png"
set datafile separator comma
set key top right opaque
set xrange [0:*]
set grid lc rgb "#dddddd"
set logscale y
set format y "%g"
set xlabel "Iteration (each with data of its own)"
set ylabel "Cross-entropy (nat) + squared velocity error (m²/s²)" font ",18"
set arrow from {chosen}, graph 0 to {chosen}, graph 1 nohead dashtype 2 lc rgb "#888888"
set label "chosen" at {chosen}, graph 0.03 right offset -0.5,0 tc rgb "#555555"
plot "{data}" using "iteration":"training_loss" with linespoints pt 7 ps 0.8 \
       lc rgb "#4477aa" title "training (last epoch)", \
     "" using "iteration":"validation_loss" with linespoints pt 7 ps 0.8 \
       lc rgb "#cc6677" title "validation"
)gnuplot";

}  // namespace

std::filesystem::path draw_losses(const std::filesystem::path& history,
                                  const std::filesystem::path& folder, int chosen_iteration) {
  return render::try_gnuplot(
      folder / "training.gp",
      fmt::format(script_text, fmt::arg("chosen", chosen_iteration),
                  fmt::arg("data", std::filesystem::relative(history, folder).string())));
}

}  // namespace touchdown::training
