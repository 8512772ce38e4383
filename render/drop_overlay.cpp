#include "render/drop_overlay.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown {

namespace {

/// The step of the drop's takeoff.
std::size_t takeoff_of(const Recording& recording, const DropOverlay& what) {
  int found = 0;
  for (const Flight& flight : flights(any_wheel(contact_labels(recording, what.labels)))) {
    const auto length = static_cast<double>(flight.landing - flight.takeoff);
    if (flight.takeoff == 0 || length * recording.period() < what.minimum_flight) continue;
    if (found++ == what.drop) return flight.takeoff;
  }
  throw InputError(
      fmt::format("overlay.drop: the run in {} has {} drops, counted from 0; none is number {}",
                  recording.info.simulator, found, what.drop));
}

/// Time since takeoff (ms), then what is drawn. Heights count from that at takeoff.
std::string columns(const Recording& recording, const DropOverlay& what) {
  const std::size_t takeoff = takeoff_of(recording, what);
  const auto steps = [&](double seconds) {
    return static_cast<std::size_t>(std::llround(seconds / recording.period()));
  };
  std::string text =
      "# time_ms\theight_m\tforce_n\tknee_torque_nm\twheel_torque_nm\tacceleration_mps2\n";
  const std::size_t begin = takeoff - std::min(takeoff, steps(what.before));
  const std::size_t end = std::min(recording.steps(), takeoff + steps(what.after));
  for (std::size_t k = begin; k < end; ++k) {
    const Observation& observation = recording.observation[k];
    const GroundTruth& truth = recording.truth[k];
    const double time = (static_cast<double>(k) - static_cast<double>(takeoff)) * 1e3;
    const std::array<double, 6> row = {
        time * recording.period(),
        truth.base_position.z() - recording.truth[takeoff].base_position.z(),
        truth.wheel_normal_force[0],
        observation.servo[index(Servo::left_knee)].torque,
        observation.servo[index(Servo::left_wheel)].torque,
        vertical_acceleration(observation.imu)};
    for (const double value : row) text.append(number(value)).append(1, '\t');
    text.back() = '\n';
  }
  return text;
}

}  // namespace

Figure draw_drop_overlay(const Recording& first, const Recording& second, const DropOverlay& what,
                         const std::filesystem::path& stem) {
  constexpr std::array<const char*, 5> labels = {"base height (m)", "normal force (N)",
                                                 "knee torque (N·m)", "wheel torque (N·m)",
                                                 "vertical acc. (m/s²)"};
  const std::string name = stem.filename().string();
  const std::array<const Recording*, 2> recordings = {&first, &second};
  std::vector<PlotData> data;
  for (const Recording* recording : recordings) {
    data.push_back(
        {fmt::format("{}_{}.dat", name, recording->info.simulator), columns(*recording, what)});
  }
  std::string commands = fmt::format(
      "set multiplot layout 5,1 title {} font ',11' margins 0.1,0.97,0.07,0.93 spacing 0,0.018\n"
      "set xrange [{}:{}]\nset arrow 1 from 0,graph 0 to 0,graph 1 nohead back lc rgb '#9aa1a8'\n"
      "set ytics nomirror autofreq\nset format x ''\nset key top left horizontal\n",
      gnuplot_text(what.title), -1e3 * what.before, 1e3 * what.after);
  for (std::size_t panel = 0; panel < labels.size(); ++panel) {
    if (panel == 1) commands += "unset key\n";
    if (panel + 1 == labels.size()) {
      commands += "set format x '%g'\nset xlabel 'time since takeoff (ms), left wheel and leg'\n";
    }
    commands += fmt::format("set ylabel {} offset 1,0\nplot ", gnuplot_text(labels[panel]));
    for (std::size_t i = 0; i < recordings.size(); ++i) {
      commands += fmt::format("{}{} using 1:{} with lines lt {} title {}", i == 0 ? "" : ", ",
                              gnuplot_text(data[i].name), panel + 2, i + 1,
                              gnuplot_text(recordings[i]->info.simulator));
    }
    commands += '\n';
  }
  commands += "unset multiplot\n";
  return draw_figure(stem, 900, 1000, commands, data);
}

}  // namespace touchdown
