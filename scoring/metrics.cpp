#include "scoring/metrics.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/yaml.hpp"

namespace touchdown::scoring {

namespace {

using Counts = TransitionCounts Score::*;

Metric transition_precision(const char* name, Counts of) {
  return {name, [of](const Score& s) { return (s.*of).precision(); },
          [of](const Score& s) { return (s.*of).detected + (s.*of).false_alarms; }};
}

Metric transition_recall(const char* name, Counts of) {
  return {name, [of](const Score& s) { return (s.*of).recall(); },
          [of](const Score& s) { return (s.*of).events; }};
}

}  // namespace

// N_ab: steps of true state a that are predicted as b, with C contact and F flight. Transitions are
// found, missed or false alarms. t: steps from a true event to its detection, negative if early.
// T: duration of a step.
const std::vector<Metric>& metrics() {
  static const std::vector<Metric> all = {
      // Accuracy: (N_CC + N_FF) / (N_CC + N_CF + N_FC + N_FF).
      {"success", [](const Score& s) { return s.points.success(); }},
      // Share of predicted contact that is true: N_CC / (N_CC + N_FC).
      {"contact_precision", [](const Score& s) { return s.points.contact_precision(); }},
      // Share of true contact that is predicted: N_CC / (N_CC + N_CF).
      {"contact_recall", [](const Score& s) { return s.points.contact_recall(); }},
      // Share of predicted flight that is true: N_FF / (N_FF + N_CF).
      {"no_contact_precision", [](const Score& s) { return s.points.no_contact_precision(); }},
      // Share of true flight that is predicted: N_FF / (N_FF + N_FC).
      {"no_contact_recall", [](const Score& s) { return s.points.no_contact_recall(); }},
      // Share of predicted takeoffs or landings that are true: found / (found + false alarms).
      transition_precision("takeoff_precision", &Score::takeoff),
      // Share of true events that are predicted in time: found / (found + missed).
      transition_recall("takeoff_recall", &Score::takeoff),
      transition_precision("landing_precision", &Score::landing),
      transition_recall("landing_recall", &Score::landing),
      // False alarms of takeoffs per scored minute of a wheel.
      {"false_takeoffs_per_minute", [](const Score& s) { return s.false_takeoffs_per_minute(); }},
      // Mean of t·T over found events, and its sample standard deviation (n − 1).
      {"takeoff_latency_ms", [](const Score& s) { return 1e3 * s.takeoff.latency_mean(); }},
      {"takeoff_latency_deviation_ms",
       [](const Score& s) { return 1e3 * s.takeoff.latency_deviation(); }},
      {"landing_latency_ms", [](const Score& s) { return 1e3 * s.landing.latency_mean(); }},
      {"landing_latency_deviation_ms",
       [](const Score& s) { return 1e3 * s.landing.latency_deviation(); }},
      // Mean squared error of P(contact), p(k), against the truth y(k): Σ (p(k) − y(k))² / N.
      {"brier", [](const Score& s) { return s.calibration.brier(); }},
  };
  return all;
}

std::size_t metric_index(std::string_view name) {
  const std::vector<Metric>& all = metrics();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Metric& m) { return m.name == name; });
  if (found != all.end()) return static_cast<std::size_t>(found - all.begin());
  std::vector<std::string> names;
  for (const Metric& metric : all) names.push_back(metric.name);
  throw InputError(
      fmt::format("unknown metric '{}' (did you mean '{}'?)", name, nearest(name, names)));
}

const std::vector<std::string>& scored_views() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = {"wheels"};
    for (const std::string_view view : view_names) all.emplace_back(view);
    return all;
  }();
  return names;
}

Score score_of_view(const RobotScore& robot, std::size_t view) {
  return view == 0 ? robot.wheels() : robot.view[view - 1];
}

}  // namespace touchdown::scoring
