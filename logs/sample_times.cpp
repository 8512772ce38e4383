#include "logs/sample_times.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace touchdown::logs {

namespace {

/// Steps between neighbours that both have a time.
std::vector<double> steps_of(std::span<const double> times) {
  std::vector<double> steps;
  double before = NAN;
  for (const double time : times) {
    if (std::isfinite(time - before)) steps.push_back(time - before);
    before = time;
  }
  return steps;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Times as whole multiples of a base step: some samples were lost, others are on time.
struct Grid {
  double step = 0.0;           ///< mean, of all multiples
  double single_step = 0.0;    ///< mean of the steps that are one base step long
  double single_share = 0.0;   ///< of those
  double fitting_share = 0.0;  ///< of the steps that are a multiple
};

Grid grid_of(std::span<const double> steps, double base) {
  constexpr double fit = 0.2;         // of a base step: jitter of a real-time loop
  constexpr double longest = 1000.0;  // base steps; a longer one is a jump of the clock
  double sum = 0.0;
  double count = 0.0;
  double single_sum = 0.0;
  double single = 0.0;
  double fitting = 0.0;
  for (const double step : steps) {
    const double multiple = std::round(step / base);
    if (multiple < 1.0 || multiple > longest || std::abs(step - multiple * base) > fit * base) {
      continue;
    }
    sum += step;
    count += multiple;
    fitting += 1.0;
    if (multiple != 1.0) continue;
    single += 1.0;
    single_sum += step;
  }
  const auto all = static_cast<double>(steps.size());
  return {count > 0.0 ? sum / count : base, single > 0.0 ? single_sum / single : base, single / all,
          fitting / all};
}

/// The straight line through the times by their number.
struct Line {
  double slope = 0.0;
  double deviation = 0.0;  ///< root mean square of the times from the line
};

Line line_through(std::span<const double> steps) {
  const auto n = static_cast<double>(steps.size() + 1);
  const double middle = 0.5 * (n - 1.0);
  std::vector<double> times = {0.0};
  for (const double step : steps) times.push_back(times.back() + step);
  double mean = 0.0;
  for (const double time : times) mean += time / n;
  double square = 0.0;
  double product = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double x = static_cast<double>(i) - middle;
    square += x * x;
    product += x * (times[i] - mean);
  }
  Line line{product / square};
  double sum = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double x = static_cast<double>(i) - middle;
    sum += std::pow(times[i] - mean - line.slope * x, 2);
  }
  line.deviation = std::sqrt(sum / n);
  return line;
}

/// The unit in which the step is between these times (s); empty if there is none.
std::string unit_between(double shortest, double longest, double step) {
  struct Unit {
    double size;
    const char* name;
  };
  constexpr std::array<Unit, 3> units = {
      {{1e3, "milliseconds"}, {1e6, "microseconds"}, {1e9, "nanoseconds"}}};
  for (const Unit& unit : units) {
    if (step >= shortest * unit.size && step <= longest * unit.size) return unit.name;
  }
  return {};
}

}  // namespace

std::optional<double> typical_step(std::span<const double> times) {
  const std::vector<double> steps = steps_of(times);
  std::vector<double> forward;
  std::ranges::copy_if(steps, std::back_inserter(forward), [](double step) { return step > 0.0; });
  if (forward.empty()) return std::nullopt;
  const double base = median(forward);
  const Grid grid = grid_of(steps, base);
  constexpr double nearly_all = 0.985;
  if (grid.single_share >= nearly_all) return grid.step;
  // Samples at equal distances, with stamps that are rounded or come in bursts, stay near a line,
  // within half a tick or half a burst. Lost samples walk away from it.
  const Line line = line_through(steps);
  const double tick = std::max(base, line.slope);
  const bool are_multiples = grid.fitting_share >= nearly_all;
  constexpr double of_rounding = 0.33;  // of a tick; uniform rounding has 0.29
  constexpr double of_bursts = 0.5;
  if (are_multiples) {
    const bool may_be_bursts = line.slope > 1.5 * base;
    const double bound = may_be_bursts ? of_bursts : of_rounding;
    return line.deviation <= bound * tick ? line.slope : grid.step;
  }
  constexpr double most = 0.85;
  if (grid.single_share >= most) return grid.single_step;  // others were late
  if (line.slope > 0.0 && line.deviation <= of_bursts * tick) return line.slope;
  if (grid.fitting_share >= most) return grid.step;
  // Neither: the mean of the steps without jumps.
  constexpr double jump = 20.0;  // typical steps
  double sum = 0.0;
  double count = 0.0;
  for (const double step : steps) {
    if (step < 0.0 || step > jump * base) continue;
    sum += step;
    count += 1.0;
  }
  return sum > 0.0 ? sum / count : base;
}

double nominal_rate(double measured) {
  constexpr double half_milliseconds = 2000.0;  // Hz
  constexpr double raster = 50.0;               // Hz
  const double steps = std::max(1.0, std::round(half_milliseconds / measured));
  for (const double candidate :
       {half_milliseconds / steps, raster * std::round(measured / raster)}) {
    if (std::abs(measured - candidate) <= rate_tolerance * candidate) return candidate;
  }
  return measured;
}

std::string unit_of_step(double step) {
  constexpr double shortest = 5e-4;  // s, at 2000 Hz: in milliseconds, less may be a slow log
  constexpr double longest = 1e-2;   // s, at 100 Hz
  return unit_between(0.999 * shortest, 1.001 * longest, step);
}

std::string unit_of_step(double step, double period) {
  constexpr double factor = 10.0;  // lost samples and coarse ticks; units differ by 1000
  return unit_between(period / factor, period * factor, step);
}

}  // namespace touchdown::logs
