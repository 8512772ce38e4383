#include "experiments/logs/summary.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown::experiments {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

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

/// Summary and score of 10 s at 1 kHz, with flights of both wheels in the truth and in the
/// decision: begin and end (ms).
using Flights = std::vector<std::array<int, 2>>;
std::string text_of(const Flights& truth, const Flights& decided) {
  const auto is_in = [](const Flights& flights, int k) {
    return std::ranges::any_of(flights, [&](const auto& f) { return k >= f[0] && k < f[1]; });
  };
  LogSummary summary(0.001, {});
  LogScore score(1000, {}, 5.33922, {}, false);
  for (int k = 0; k < 10'000; ++k) {
    Belief belief;
    belief.status = SignalStatus::good;
    const bool contact = !is_in(decided, k);
    for (auto& wheel : belief.wheel) {
      wheel.contact = contact;
      wheel.p_contact = contact ? 1.0 : 0.0;
    }
    const double force = is_in(truth, k) ? 0.0 : 26.0;
    summary.add(0.001 * k, belief);
    score.add(std::array{force, force}, {}, belief);
  }
  return summary.text(score.finish());
}

TEST(LogSummary, AccountsForTheDifferenceBetweenTheListOfTakeoffsAndTheirScore) {
  const Flights truth = {{2000, 2200}, {5000, 5200}};
  EXPECT_THAT(text_of(truth, truth), HasSubstr("takeoffs 4 of 4 found, latency 0.0 ± 0.0 ms, 0 "
                                               "false; landings"));
  EXPECT_THAT(text_of(truth, {{2000, 2200}, {5000, 5200}, {7000, 7020}}),
              AllOf(HasSubstr("takeoffs at (s) 2.000, 5.000; landings"),
                    HasSubstr("2 false, 2 of those that are found before a state under 50 ms and "
                              "not listed")));
  EXPECT_THAT(text_of(truth, {{2000, 2200}, {5000, 5200}, {7000, 7100}}),
              AllOf(HasSubstr("takeoffs at (s) 2.000, 5.000, 7.000; landings"),
                    HasSubstr("2 false; landings")));
  EXPECT_THAT(text_of({}, truth),
              HasSubstr("F1 of takeoffs and landings none (the truth has no takeoff or landing"));
  EXPECT_THAT(text_of(truth, truth), HasSubstr("both 95.9 %, after the first 0.3 s\n"));
}

TEST(LogSummary, NamesATruthThatIsShiftedByAConstantTime) {
  const Flights truth = {{2000, 2200}, {4000, 4250}, {6000, 6150}};
  const auto shifted = [&](int late, int jitter) {
    Flights flights = truth;
    for (std::size_t i = 0; i < flights.size(); ++i) {
      for (int& edge : flights[i]) edge += late + jitter * static_cast<int>(i);
    }
    return text_of(truth, flights);
  };
  EXPECT_THAT(shifted(50, 0), HasSubstr("all landings are found 50 ms late: is the clock"));
  EXPECT_THAT(shifted(100, 2), HasSubstr("all landings are found 102 ms late"));
  EXPECT_THAT(shifted(10, 0), Not(HasSubstr("shifted?"))) << "an estimator's own delay";
  EXPECT_THAT(shifted(50, 20), Not(HasSubstr("shifted?"))) << "not constant";
}

}  // namespace
}  // namespace touchdown::experiments
