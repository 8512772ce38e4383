#include "experiments/logs/log_steps.hpp"

#include <memory>

#include <gtest/gtest.h>

#include "logs/log/recording_file.hpp"

namespace touchdown::experiments {
namespace {

/// A robot's log at 1 kHz from 0 to 0.999 s.
std::shared_ptr<const logs::Recording> second() {
  auto log = std::make_shared<logs::Recording>();
  for (int k = 0; k < 1000; ++k) {
    models::Observation& now = log->observation.emplace_back();
    now.time = 0.001 * k;
  }
  log->action.resize(log->steps());
  return log;
}

/// The labelled steps of that log, with labels of these intervals.
std::vector<int> labelled(std::vector<logs::ContactInterval> intervals) {
  const logs::ContactIntervals labels{"labels.csv", std::move(intervals)};
  logs::LogReader reader(logs::records_of(second()), "log");
  LogSteps log(reader, &labels);
  std::vector<int> steps;
  for (int k = 0; const LogStep* const step = log.next(); ++k) {
    if (step->normal_force) steps.push_back(k);
  }
  return steps;
}

TEST(LabelsOfALog, ThatEndAtItsLastStepContainIt) {
  for (const double end : {0.999, 0.99900000001, 0.9990000000001, 1.0, 5.0}) {
    const std::vector<int> steps = labelled({{0.0, 0.5, {true, true}}, {0.5, end, {false, false}}});
    EXPECT_EQ(steps.size(), 1000U) << end;
  }
  EXPECT_EQ(labelled({{0.0, 0.998, {true, true}}}).back(), 998);
  EXPECT_EQ(labelled({{0.0, 0.9979, {true, true}}}).back(), 997);
}

TEST(LabelsOfALog, LeaveGapsUnlabelled) {
  const std::vector<int> steps = labelled({{0.1, 0.2, {true, true}}, {0.5, 0.6, {false, true}}});
  ASSERT_EQ(steps.size(), 201U);
  EXPECT_EQ(steps.front(), 100);
  EXPECT_EQ(steps[99], 199) << "the end before a gap is in it";
  EXPECT_EQ(steps[100], 500);
  EXPECT_EQ(steps.back(), 600) << "the last end";
}

}  // namespace
}  // namespace touchdown::experiments
