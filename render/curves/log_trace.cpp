#include "render/curves/log_trace.hpp"

#include <cmath>

#include "render/gnuplot/text.hpp"

namespace touchdown::render {

namespace {

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? NAN : static_cast<double>(part) / static_cast<double>(whole);
}

void append(std::string& text, double value) { text.append(number(value)).append(1, '\t'); }

}  // namespace

LogTraceStep log_trace_step(const Signals& signals, const Belief& belief, double p_takeoff,
                            double p_landing) {
  LogTraceStep step;
  step.time = signals.time;
  step.value = {signals.leg[0].knee.torque,
                signals.leg[1].knee.torque,
                signals.leg[0].wheel.torque,
                signals.leg[1].wheel.torque,
                signals.vertical_acceleration,
                belief.wheel[0].p_contact,
                belief.wheel[1].p_contact,
                p_takeoff,
                p_landing};
  step.contact = {belief.wheel[0].contact, belief.wheel[1].contact};
  step.status = belief.status;
  return step;
}

LogTrace::Bin::Bin(const LogTraceStep& step)
    : begin(step.time), end(step.time), steps(1), low(step.value), high(step.value) {
  for (std::size_t wheel = 0; wheel < 2; ++wheel) {
    contact[wheel] = step.contact[wheel] ? 1 : 0;
    touches[wheel] = step.touches && (*step.touches)[wheel] ? 1 : 0;
  }
  with_truth = step.touches ? 1 : 0;
  status[static_cast<std::size_t>(step.status)] = 1;
}

void LogTrace::Bin::merge(const Bin& later) {
  end = later.end;
  steps += later.steps;
  with_truth += later.with_truth;
  for (std::size_t i = 0; i < log_curve_count; ++i) {
    // NaN counts as no value, infinity as a curve that leaves the plot.
    low[i] = std::fmin(low[i], later.low[i]);
    high[i] = std::fmax(high[i], later.high[i]);
  }
  for (std::size_t wheel = 0; wheel < 2; ++wheel) {
    contact[wheel] += later.contact[wheel];
    touches[wheel] += later.touches[wheel];
  }
  for (std::size_t i = 0; i < status.size(); ++i) status[i] += later.status[i];
}

void LogTrace::add(const LogTraceStep& step) {
  if (!bins_.empty() && bins_.back().steps < steps_per_bin_) {
    bins_.back().merge(Bin(step));
    return;
  }
  if (bins_.size() >= most_bins_) {
    for (std::size_t i = 0; 2 * i < bins_.size(); ++i) {
      Bin merged = bins_[2 * i];
      if (2 * i + 1 < bins_.size()) merged.merge(bins_[2 * i + 1]);
      bins_[i] = merged;
    }
    bins_.erase(bins_.begin() + static_cast<std::ptrdiff_t>((bins_.size() + 1) / 2), bins_.end());
    steps_per_bin_ *= 2;
    add(step);
    return;
  }
  bins_.emplace_back(step);
}

std::string LogTrace::table() const {
  std::string text =
      "# begin_s\tend_s\tlow and high of: left knee, right knee, left wheel, right wheel (N m), "
      "vertical acceleration (m/s2), p_contact left, right, p_takeoff, p_landing\tshare of steps "
      "decided as contact: left, right\ttrue contact: left, right\tsteps good, invalid, gap, "
      "frozen\n";
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    const Bin& bin = bins_[i];
    const std::size_t gap = static_cast<std::size_t>(SignalStatus::gap);
    if (i > 0 && bin.status[gap] > 0) text += '\n';
    append(text, bin.begin);
    append(text, bin.end);
    for (std::size_t c = 0; c < log_curve_count; ++c) {
      append(text, bin.low[c]);
      append(text, bin.high[c]);
    }
    for (const std::size_t steps : bin.contact) append(text, share(steps, bin.steps));
    for (const std::size_t steps : bin.touches) append(text, share(steps, bin.with_truth));
    for (const std::size_t steps : bin.status) append(text, static_cast<double>(steps));
    text.back() = '\n';
  }
  return text;
}

}  // namespace touchdown::render
