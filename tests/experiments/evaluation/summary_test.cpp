#include "experiments/evaluation/summary.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

/// A condition that decides `delay` steps late in ten runs with one flight each.
ConditionScores delayed_by(const std::string& estimator, std::ptrdiff_t delay) {
  ConditionScores scores{{"mujoco", "mujoco", estimator}, {{}}};
  for (std::ptrdiff_t run = 0; run < 10; ++run) {
    const auto sequence = [&](std::ptrdiff_t shift) {
      scoring::ContactSequence contact(2000, 1);
      std::fill(contact.begin() + 1000 + shift, contact.begin() + 1100 + 10 * run + shift, 0);
      return contact;
    };
    const scoring::ContactSequence predicted = sequence(delay);
    scoring::Prediction prediction;
    prediction.fill({predicted, {predicted.begin(), predicted.end()}});
    const auto segments = scoring::score({sequence(0), sequence(0)}, prediction, {0}, 1000, {});
    scores.samples[0].push_back(segments.front());
  }
  return scores;
}

TEST(Summary, CoversEveryViewAndMetric) {
  const std::vector<noise::NoiseCell> cells = {{0.25, 0.0}};
  const auto summaries = summarise({delayed_by("robust", 12)}, cells, {.resamples = 50});
  ASSERT_EQ(summaries.size(), scoring::scored_views().size());
  for (const ScoreSummary& summary : summaries) {
    EXPECT_EQ(summary["takeoff_recall"].estimate, 1.0);
    EXPECT_DOUBLE_EQ(summary["takeoff_latency_ms"].estimate, 12.0);
    EXPECT_NEAR(summary["landing_latency_deviation_ms"].estimate, 0.0, 1e-9);
    // 88 of 100 to 178 of 190 steps: the runs differ in this, so its interval has a width.
    EXPECT_LT(summary["no_contact_recall"].low, summary["no_contact_recall"].high);
  }
  EXPECT_EQ(summaries[0].view, "wheels");
  EXPECT_EQ(summaries[0].total.takeoff.events, 20);
  EXPECT_EQ(summaries[1].total.takeoff.events, 10);
  // All of them were found, in every resample.
  EXPECT_NEAR(summaries[0]["takeoff_recall"].low, std::pow(0.025, 1.0 / 20.0), 1e-12);
  EXPECT_NEAR(summaries[1]["takeoff_recall"].low, std::pow(0.025, 1.0 / 10.0), 1e-12);
}

TEST(Summary, DifferencesArePairedByRun) {
  const std::vector<noise::NoiseCell> cells = {{}};
  const auto all = differences({delayed_by("robust", 5), delayed_by("paper", 12)}, cells, {});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].second, "paper");
  const Interval& latency = all[0].metric[scoring::metric_index("takeoff_latency_ms")];
  EXPECT_NEAR(latency.estimate, -7.0, 1e-9);
  // Every run has the same difference, however different the runs are.
  EXPECT_NEAR(latency.low, -7.0, 1e-9);
  EXPECT_NEAR(latency.high, -7.0, 1e-9);
}

}  // namespace
}  // namespace touchdown::experiments
