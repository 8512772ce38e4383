#include "render/curves/drop_detail_data.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace touchdown::render {

std::vector<double> in_ms(std::vector<double> seconds) {
  // To the nanosecond: the product alone would say 345.00000000000006.
  for (double& time : seconds) time = std::round(1e9 * time) / 1e6;
  return seconds;
}

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

std::string spectrum_text(const experiments::SpectrumTrace& trace, double bin_width) {
  constexpr double floor = 1e-6;  // −60 dB: nothing
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

}  // namespace touchdown::render
