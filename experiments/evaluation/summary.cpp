#include "experiments/evaluation/summary.hpp"

#include <tbb/parallel_for.h>

namespace touchdown::experiments {

namespace {

using Statistics = std::vector<std::function<double(const scoring::Score&)>>;

std::vector<scoring::Score> samples_of(const ConditionScores& scores, std::size_t cell,
                                       std::size_t view) {
  std::vector<scoring::Score> samples;
  for (const scoring::RobotScore& robot : scores.samples[cell])
    samples.push_back(scoring::score_of_view(robot, view));
  return samples;
}

Statistics metric_functions() {
  Statistics all;
  for (const scoring::Metric& metric : scoring::metrics()) all.push_back(metric.of);
  return all;
}

/// The metrics, then the share of contact in each bin of the reliability curve.
Statistics metric_and_reliability_functions() {
  Statistics all = metric_functions();
  for (std::size_t b = 0; b < scoring::Calibration::bins; ++b) {
    all.emplace_back(
        [b](const scoring::Score& s) { return s.calibration.bin[b].contact_frequency(); });
  }
  return all;
}

}  // namespace

std::vector<ScoreSummary> summarise(const std::vector<ConditionScores>& scores,
                                    std::span<const noise::NoiseCell> cells,
                                    const scoring::BootstrapConfig& config) {
  const std::size_t views = scoring::scored_views().size();
  std::vector<ScoreSummary> summaries(cells.size() * scores.size() * views);
  tbb::parallel_for(std::size_t{0}, summaries.size(), [&](std::size_t i) {
    const std::size_t cell = i / views / scores.size();
    const ConditionScores& condition = scores[i / views % scores.size()];
    const std::vector<scoring::Score> samples = samples_of(condition, cell, i % views);
    const scoring::Score sum = scoring::sum(samples);
    std::vector<Interval> intervals =
        scoring::bootstrap<scoring::Score>(samples, metric_and_reliability_functions(), config);
    for (std::size_t m = 0; m < scoring::metrics().size(); ++m) {
      const auto& events = scoring::metrics()[m].events;
      if (events) intervals[m] = scoring::with_exact_end(intervals[m], events(sum), config.level);
    }
    const auto bins = intervals.end() - static_cast<std::ptrdiff_t>(scoring::Calibration::bins);
    summaries[i] = {condition.condition,
                    cells[cell],
                    scoring::scored_views()[i % views],
                    sum,
                    {intervals.begin(), bins},
                    {bins, intervals.end()}};
  });
  return summaries;
}

std::vector<Difference> differences(const std::vector<ConditionScores>& scores,
                                    std::span<const noise::NoiseCell> cells,
                                    const scoring::BootstrapConfig& config) {
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
  std::vector<Difference> result(cells.size() * pairs.size());
  tbb::parallel_for(std::size_t{0}, result.size(), [&](std::size_t i) {
    const std::size_t cell = i / pairs.size();
    const auto& [one, other] = pairs[i % pairs.size()];
    result[i] = {
        one->condition.test_simulator, cells[cell], one->condition.estimator,
        other->condition.estimator,
        scoring::bootstrap_differences(samples_of(*one, cell, 0), samples_of(*other, cell, 0),
                                       metric_functions(), config)};
  });
  return result;
}

}  // namespace touchdown::experiments
