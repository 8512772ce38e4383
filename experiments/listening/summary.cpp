#include "experiments/listening/summary.hpp"

#include <tbb/parallel_for.h>

namespace touchdown::experiments {

namespace {

std::vector<scoring::Score> samples_of(const ConditionScores& scores, std::size_t view) {
  std::vector<scoring::Score> samples;
  for (const scoring::RobotScore& robot : scores.samples)
    samples.push_back(scoring::score_of_view(robot, view));
  return samples;
}

std::vector<std::function<double(const scoring::Score&)>> functions() {
  std::vector<std::function<double(const scoring::Score&)>> all;
  for (const scoring::Metric& metric : scoring::metrics()) all.push_back(metric.of);
  return all;
}

/// The metrics, then the share of contact in each bin of the reliability curve.
std::vector<std::function<double(const scoring::Score&)>> functions_with_reliability() {
  std::vector<std::function<double(const scoring::Score&)>> all = functions();
  for (std::size_t b = 0; b < scoring::Calibration::bins; ++b) {
    all.emplace_back(
        [b](const scoring::Score& s) { return s.calibration.bin[b].contact_frequency(); });
  }
  return all;
}

Difference difference(const ConditionScores& first, const ConditionScores& second,
                      const noise::NoiseCell& cell, const scoring::BootstrapConfig& config) {
  const std::vector<scoring::Score> a = samples_of(first, 0);
  const std::vector<scoring::Score> b = samples_of(second, 0);
  std::vector<scoring::Paired<scoring::Score>> pairs;
  for (std::size_t i = 0; i < a.size(); ++i) pairs.push_back({a[i], b[i]});
  std::vector<std::function<double(const scoring::Paired<scoring::Score>&)>> statistics;
  for (const auto& of : functions()) {
    statistics.emplace_back(
        [of](const scoring::Paired<scoring::Score>& p) { return of(p.first) - of(p.second); });
  }
  return {first.condition.test_simulator, cell, first.condition.estimator,
          second.condition.estimator,
          scoring::bootstrap<scoring::Paired<scoring::Score>>(pairs, statistics, config)};
}

}  // namespace

std::vector<ScoreSummary> summarise(const std::vector<ConditionScores>& scores,
                                    const noise::NoiseCell& cell,
                                    const scoring::BootstrapConfig& config) {
  const std::size_t views = scoring::scored_views().size();
  std::vector<ScoreSummary> summaries(scores.size() * views);
  tbb::parallel_for(std::size_t{0}, summaries.size(), [&](std::size_t i) {
    const ConditionScores& condition = scores[i / views];
    const std::vector<scoring::Score> samples = samples_of(condition, i % views);
    scoring::Score total;
    for (const scoring::Score& sample : samples) total += sample;
    std::vector<Interval> intervals =
        scoring::bootstrap<scoring::Score>(samples, functions_with_reliability(), config);
    const auto bins = intervals.end() - static_cast<std::ptrdiff_t>(scoring::Calibration::bins);
    summaries[i] = {condition.condition,
                    cell,
                    scoring::scored_views()[i % views],
                    total,
                    {intervals.begin(), bins},
                    {bins, intervals.end()}};
  });
  return summaries;
}

std::vector<Difference> differences(const std::vector<ConditionScores>& scores,
                                    const noise::NoiseCell& cell,
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
  std::vector<Difference> result(pairs.size());
  tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t i) {
    result[i] = difference(*pairs[i].first, *pairs[i].second, cell, config);
  });
  return result;
}

}  // namespace touchdown::experiments
