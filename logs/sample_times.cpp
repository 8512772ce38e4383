#include "logs/sample_times.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/table.hpp"

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
  for (const auto& [unit, name] :
       {std::pair(1e3, "milliseconds"), {1e6, "microseconds"}, {1e9, "nanoseconds"}}) {
    if (step >= shortest * unit && step <= longest * unit) return name;
  }
  return {};
}

}  // namespace

std::int64_t nanoseconds(double seconds) {
  const double whole = std::floor(seconds);
  constexpr double furthest = 9e9;  // s, whose nanoseconds an integer holds
  if (!(std::abs(whole) < furthest)) return 0;
  return 1'000'000'000 * static_cast<std::int64_t>(whole) + std::llround(1e9 * (seconds - whole));
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::optional<double> typical_step(std::span<const double> times) {
  const std::vector<double> steps = steps_of(times);
  std::vector<double> forward;
  std::ranges::copy_if(steps, std::back_inserter(forward), [](double step) { return step > 0.0; });
  if (forward.empty()) return std::nullopt;
  const double base = median(forward);
  const Grid grid = grid_of(steps, base);
  constexpr double nearly_all = 0.985;
  if (grid.single_share >= nearly_all) return grid.step;
  if (!interleaved_clocks(times).empty()) return line_through(steps).slope;
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

namespace {

/// The period of the clock that gives the first of these times and others of them, and the times
/// that remain without it. Empty without such a clock.
std::optional<double> take_clock(std::vector<double>& times, double tolerance) {
  constexpr std::size_t furthest = 12;
  constexpr double nearly_all = 0.95;
  for (std::size_t other = 1; other < std::min(furthest, times.size()); ++other) {
    const double period = times[other] - times[0];
    std::vector<double> rest;
    double next = times[0];
    double hits = 0.0;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const bool is_nearest =
          i + 1 == times.size() || std::abs(times[i] - next) <= std::abs(times[i + 1] - next);
      if (std::abs(times[i] - next) <= tolerance && is_nearest) {
        next = times[i] + period;
        hits += 1.0;
        continue;
      }
      rest.push_back(times[i]);
      while (next + tolerance < times[i]) next += period;
    }
    const double expected = 1.0 + std::floor((times.back() - times[0]) / period + 0.1);
    constexpr double few = 8.0;
    if (hits < few || hits < nearly_all * expected) continue;
    times = std::move(rest);
    return period;
  }
  return std::nullopt;
}

/// The periods of the clocks that give these times.
std::vector<double> clocks_of(std::vector<double> times, double tolerance) {
  std::vector<double> periods;
  const std::size_t few = times.size() / 20;
  while (times.size() > few) {
    const std::optional<double> period = take_clock(times, tolerance);
    if (!period) return {};
    periods.push_back(*period);
  }
  return periods;
}

/// Whether the steps differ no more than rounding, jitter and single lost samples make them.
bool are_even(std::vector<double> steps, double mean) {
  std::sort(steps.begin(), steps.end());
  const double spread = steps[steps.size() * 19 / 20] - steps[steps.size() / 20];
  double tick = std::min(spread, steps[steps.size() / 20]);
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const double apart = steps[i] - steps[i - 1];
    if (apart > 0.02 * mean) tick = std::min(tick, apart);
  }
  return spread <= 0.5 * mean || spread <= 1.5 * tick;
}

/// Bursts at a period, of which the sizes may differ: "bursts of 4 every 10 ms".
std::string bursts_of(const std::vector<double>& times, double mean) {
  std::vector<double> starts;
  std::size_t first = 0;
  std::size_t last = 0;
  double within = 0.0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] - times[i - 1] > 2.0 * mean) {
      if (starts.empty()) first = i;
      last = i;
      starts.push_back(times[i]);
    } else {
      within += times[i] - times[i - 1];
    }
  }
  constexpr std::size_t few = 8;
  if (starts.size() < few || within > 0.5 * (times.back() - times.front())) return {};
  const std::vector<double> periods = steps_of(starts);
  const double period = median(periods);
  const auto regular = std::ranges::count_if(
      periods, [&](double one) { return std::abs(one - period) < 0.25 * period; });
  if (static_cast<double>(regular) < 0.8 * static_cast<double>(periods.size())) return {};
  const double size = static_cast<double>(last - first) / static_cast<double>(periods.size());
  return fmt::format("bursts of {} every {} ms", readable(size, 2), readable(1e3 * period, 3));
}

}  // namespace

std::string interleaved_clocks(std::span<const double> times) {
  std::vector<double> finite;
  for (const double time : times) {
    if (std::isfinite(time) && (finite.empty() || time > finite.back())) finite.push_back(time);
  }
  constexpr std::size_t few = 40;
  if (finite.size() < few) return {};
  const std::vector<double> steps = steps_of(finite);
  const double mean = (finite.back() - finite.front()) / static_cast<double>(steps.size());
  if (are_even(steps, mean)) return {};
  std::vector<double> clocks = clocks_of(finite, 0.15 * mean);
  std::sort(clocks.begin(), clocks.end());
  const bool are_publishers = clocks.size() > 1 && clocks.back() > 1.1 * clocks.front();
  std::string bursts = bursts_of(finite, mean);
  // A cycle that is late again and again is no pause between bursts.
  const auto is_pause = [&](double step) { return step > 0.49 * clocks.front(); };
  if (bursts.empty() && clocks.size() > 1 && !are_publishers &&
      static_cast<std::size_t>(std::ranges::count_if(steps, is_pause)) > finite.size() / 40) {
    bursts =
        fmt::format("bursts of {} every {} ms", clocks.size(), readable(1e3 * clocks.front(), 3));
  }
  constexpr std::size_t most_publishers = 3;
  if (!bursts.empty() && (!are_publishers || clocks.size() > most_publishers)) {
    return fmt::format(
        "records come in {}, as times of receiving do: use the stamps of the headers{}", bursts,
        clocks.size() > 1 && clocks.size() <= most_publishers
            ? fmt::format("; or do {} publishers share a topic", clocks.size())
            : "");
  }
  if (!are_publishers) return {};
  std::string each;
  for (const double clock : clocks) {
    each += fmt::format("{}one every {} ms", each.empty() ? "" : ", ", readable(1e3 * clock, 3));
  }
  return fmt::format(
      "stamps of {} clocks alternate, {}: do {} publishers share a topic? The rate is theirs "
      "together: record one of them alone",
      clocks.size(), each, clocks.size());
}

void UnpaddedFractions::add(double time) {
  const double step = time - std::exchange(previous_, time);
  const double before = std::exchange(step_, step);
  if (expected_ > 0.0) {
    if (step > 0.5 * expected_ && step < 2.0 * expected_) ++count_;
    expected_ = 0.0;
  }
  constexpr double rounding = 1e-6;  // s, of a time since 1970
  const double whole = std::floor(time + rounding);
  const double fraction = time - whole;
  const bool is_power = fraction > 0.1 - rounding && fraction < 0.2;
  if (!(step < 0.0 && is_power && before > 0.0 && time - step < whole + 1.0 - rounding)) return;
  expected_ = 0.1 * before;
  before_ = fraction - step;
  after_ = fraction;
}

std::string UnpaddedFractions::text() const {
  return fmt::format(
      "and its steps become a tenth, as from .{0} to .{1}: unpadded fractions? Then 1.9 and 1.10 "
      "mean 9 and 10 ms, µs or ns: pad them with zeros, or map the two numbers as `sec` and "
      "`nanosec` of `time`; sorting would scramble the log",
      fmt::format("{:.4g}", before_).substr(2), fmt::format("{:.4g}", after_).substr(2));
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
