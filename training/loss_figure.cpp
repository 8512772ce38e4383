#include "training/loss_figure.hpp"

#include <array>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "core/files.hpp"

namespace touchdown {

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

bool run_gnuplot(const std::filesystem::path& script) {
  std::string program = "gnuplot";
  std::string file = script.filename().string();
  const std::array<char*, 3> arguments = {program.data(), file.data(), nullptr};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addchdir_np(&actions, script.parent_path().c_str());
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  return error == 0 && ::waitpid(child, &status, 0) == child && WIFEXITED(status) &&
         WEXITSTATUS(status) == 0;
}

std::filesystem::path draw_losses(const std::filesystem::path& history,
                                  const std::filesystem::path& folder, int chosen_iteration) {
  const auto script = folder / "training.gp";
  write_atomically(
      script, fmt::format(script_text, fmt::arg("chosen", chosen_iteration),
                          fmt::arg("data", std::filesystem::relative(history, folder).string())));
  return run_gnuplot(script) ? folder / "training.png" : std::filesystem::path();
}

}  // namespace touchdown
