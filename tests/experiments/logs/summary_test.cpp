#include "experiments/logs/summary.hpp"

#include <map>
#include <string>

#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

/// The line about signals of a log of 1000 steps with these statuses at the named steps.
std::string signals_line(const std::map<int, SignalStatus>& statuses, SignalStatus others,
                         std::size_t findings = 0) {
  LogSummary summary(0.001, {});
  for (int k = 0; k < 1000; ++k) {
    Belief belief;
    const auto found = statuses.find(k);
    belief.status = found == statuses.end() ? others : found->second;
    if (belief.status == SignalStatus::invalid) {
      belief.unusable = static_cast<SignalIndex>(18);
    }
    summary.add(0.001 * k, belief);
  }
  const std::string text = summary.text({}, 0.0, findings);
  const std::size_t begin = text.find("signals");
  return text.substr(begin + 13, text.find('\n', begin) - begin - 13);
}

TEST(LogSummary, ReportsStepsWithoutTargetsBesideUnusableSignals) {
  using enum SignalStatus;
  EXPECT_EQ(signals_line({}, good), "all good");
  EXPECT_EQ(signals_line({}, degraded), "all good; no targets of joints");
  // The first record of a log has no command before it.
  EXPECT_EQ(signals_line({{0, degraded}}, good), "all good");
  EXPECT_EQ(signals_line({{1, degraded}}, good),
            "all good; no targets of joints at 1 of 1000 steps");
  EXPECT_EQ(signals_line({{0, degraded}, {999, degraded}}, good),
            "all good; no targets of joints at 2 of 1000 steps");
  EXPECT_EQ(signals_line({{5, good}}, degraded),
            "all good; no targets of joints at 999 of 1000 steps");
  EXPECT_EQ(signals_line({}, degraded, 2),
            "not plausible: 2 findings, printed above; no targets of joints");
  EXPECT_EQ(signals_line({{0, degraded}}, good, 1), "not plausible: 1 finding, printed above");
  EXPECT_EQ(signals_line({{0, degraded}, {7, gap}}, good), "1 gap of 1000 steps");
  EXPECT_EQ(signals_line({{3, invalid}, {7, gap}, {8, frozen}}, degraded, 1),
            "1 invalid, 1 gap, 1 frozen of 1000 steps; unusable: acceleration x; not plausible: 1 "
            "finding, printed above; no targets of joints at 997 of 1000 steps");
}

}  // namespace
}  // namespace touchdown::experiments
