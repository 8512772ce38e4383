#include "experiments/metrics.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "core/error.hpp"
#include "core/yaml.hpp"

namespace touchdown {

namespace {

std::vector<Score> samples_of(const ConditionScores& scores, std::size_t view) {
  std::vector<Score> samples;
  for (const RobotScore& robot : scores.samples) {
    samples.push_back(view == 0 ? robot.wheels() : robot.view[view - 1]);
  }
  return samples;
}

std::vector<std::function<double(const Score&)>> functions() {
  std::vector<std::function<double(const Score&)>> all;
  for (const Metric& metric : metrics()) all.push_back(metric.of);
  return all;
}

/// The metrics, then the share of contact in each bin of the reliability curve.
std::vector<std::function<double(const Score&)>> functions_with_reliability() {
  std::vector<std::function<double(const Score&)>> all = functions();
  for (std::size_t b = 0; b < Calibration::bins; ++b) {
    all.emplace_back([b](const Score& s) { return s.calibration.bin[b].contact_frequency(); });
  }
  return all;
}

Difference difference(const ConditionScores& first, const ConditionScores& second,
                      const NoiseCell& cell, const BootstrapConfig& config) {
  const std::vector<Score> a = samples_of(first, 0);
  const std::vector<Score> b = samples_of(second, 0);
  std::vector<Paired<Score>> pairs;
  for (std::size_t i = 0; i < a.size(); ++i) pairs.push_back({a[i], b[i]});
  std::vector<std::function<double(const Paired<Score>&)>> statistics;
  for (const auto& of : functions()) {
    statistics.emplace_back([of](const Paired<Score>& p) { return of(p.first) - of(p.second); });
  }
  return {first.condition.test_simulator, cell, first.condition.estimator,
          second.condition.estimator, bootstrap<Paired<Score>>(pairs, statistics, config)};
}

}  // namespace

const std::vector<Metric>& metrics() {
  static const std::vector<Metric> all = {
      {"success", [](const Score& s) { return s.points.success(); }},
      {"contact_precision", [](const Score& s) { return s.points.contact_precision(); }},
      {"contact_recall", [](const Score& s) { return s.points.contact_recall(); }},
      {"no_contact_precision", [](const Score& s) { return s.points.no_contact_precision(); }},
      {"no_contact_recall", [](const Score& s) { return s.points.no_contact_recall(); }},
      {"takeoff_precision", [](const Score& s) { return s.takeoff.precision(); }},
      {"takeoff_recall", [](const Score& s) { return s.takeoff.recall(); }},
      {"landing_precision", [](const Score& s) { return s.landing.precision(); }},
      {"landing_recall", [](const Score& s) { return s.landing.recall(); }},
      {"takeoff_latency_ms", [](const Score& s) { return 1e3 * s.takeoff.latency_mean(); }},
      {"takeoff_latency_deviation_ms",
       [](const Score& s) { return 1e3 * s.takeoff.latency_deviation(); }},
      {"landing_latency_ms", [](const Score& s) { return 1e3 * s.landing.latency_mean(); }},
      {"landing_latency_deviation_ms",
       [](const Score& s) { return 1e3 * s.landing.latency_deviation(); }},
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

std::vector<ScoreSummary> summarise(const std::vector<ConditionScores>& scores,
                                    const NoiseCell& cell, const BootstrapConfig& config) {
  const std::size_t views = scored_views().size();
  std::vector<ScoreSummary> summaries(scores.size() * views);
  tbb::parallel_for(std::size_t{0}, summaries.size(), [&](std::size_t i) {
    const ConditionScores& condition = scores[i / views];
    const std::vector<Score> samples = samples_of(condition, i % views);
    Score total;
    for (const Score& sample : samples) total += sample;
    std::vector<Interval> intervals =
        bootstrap<Score>(samples, functions_with_reliability(), config);
    const auto bins = intervals.end() - static_cast<std::ptrdiff_t>(Calibration::bins);
    summaries[i] = {condition.condition,       cell,
                    scored_views()[i % views], total,
                    {intervals.begin(), bins}, {bins, intervals.end()}};
  });
  return summaries;
}

std::vector<Difference> differences(const std::vector<ConditionScores>& scores,
                                    const NoiseCell& cell, const BootstrapConfig& config) {
  std::vector<std::pair<const ConditionScores*, const ConditionScores*>> pairs;
  const ConditionScores* first = nullptr;
  for (const ConditionScores& other : scores) {
    const bool new_engine =
        first == nullptr || first->condition.test_simulator != other.condition.test_simulator;
    if (new_engine) {
      first = &other;
    } else {
      pairs.emplace_back(first, &other);
    }
  }
  std::vector<Difference> result(pairs.size());
  tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t i) {
    result[i] = difference(*pairs[i].first, *pairs[i].second, cell, config);
  });
  return result;
}

}  // namespace touchdown
