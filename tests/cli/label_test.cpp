#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "logs/log/contact_intervals.hpp"
#include "logs/log/recording_file.hpp"
#include "program.hpp"
#include "scoring/labels.hpp"
#include "synthetic_log.hpp"

namespace touchdown::cli {
namespace {

using ::testing::HasSubstr;

class Label : public InFolder {
 protected:
  logs::Recording simulated() const {
    folder_.output_of("simulate scenarios/stairs.yaml --set end.duration=8 -o run.mpack");
    return logs::read_recording(folder_ / "run.mpack");
  }
  logs::ContactIntervals labels_of(const std::string& log) const {
    folder_.output_of("estimate " + log + " --propose labels.csv");
    return logs::read_contact_intervals(folder_ / "labels.csv");
  }
};

double time_of(const logs::Recording& log, std::size_t step) {
  return 1e-6 * static_cast<double>(log.info.control_period_us) * static_cast<double>(step);
}

/// Seconds from the takeoffs and landings of a wheel's flights, of 30 ms and more, to the nearest
/// labelled ones; sorted.
std::vector<double> edge_errors(const logs::Recording& log, const logs::ContactIntervals& labels) {
  std::vector<double> errors;
  const auto truth = scoring::contact_labels(log, {});
  for (std::size_t wheel = 0; wheel < truth.size(); ++wheel) {
    const auto add = [&](std::size_t step, bool contact) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 1; i < labels.intervals.size(); ++i) {
        const logs::ContactInterval& one = labels.intervals[i];
        const bool before = labels.intervals[i - 1].contact[wheel];
        if (one.contact[wheel] != contact || before == contact) continue;
        nearest = std::min(nearest, std::abs(one.start - time_of(log, step)));
      }
      errors.push_back(nearest);
    };
    for (const scoring::Flight& flight : scoring::flights(truth[wheel])) {
      if (flight.landing - flight.takeoff < 30) continue;
      add(flight.takeoff, false);
      add(flight.landing, true);
    }
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

TEST_F(Label, EdgesAreWithinMillisecondsOfTheTruth) {
  const logs::Recording run = simulated();
  const logs::ContactIntervals labels = labels_of("run.mpack");
  const std::vector<double> errors = edge_errors(run, labels);
  ASSERT_GE(errors.size(), 4U);
  EXPECT_LT(errors[errors.size() / 2], 0.012);
  EXPECT_LE(errors.back(), 0.03) << "no flight is missed";
  EXPECT_NEAR(labels.intervals.front().start, time_of(run, 0), 1e-9);
  EXPECT_NEAR(labels.intervals.back().end, time_of(run, run.steps()), 1e-6);
  for (std::size_t i = 0; i < labels.intervals.size(); ++i) {
    const logs::ContactInterval& one = labels.intervals[i];
    EXPECT_TRUE(one.sure.has_value());
    if (i == 0) continue;
    EXPECT_EQ(one.start, labels.intervals[i - 1].end);
    EXPECT_NE(one.contact, labels.intervals[i - 1].contact);
  }
}

TEST_F(Label, ListsTheLeastSureIntervalsFirst) {
  (void)simulated();
  const std::string text = folder_.output_of("estimate run.mpack --propose labels.csv");
  const logs::ContactIntervals labels = logs::read_contact_intervals(folder_ / "labels.csv");
  const auto least =
      std::min_element(labels.intervals.begin(), labels.intervals.end(),
                       [](const auto& one, const auto& other) { return one.sure < other.sure; });
  const std::size_t rule = text.find("─\n");
  ASSERT_NE(rule, std::string::npos);
  EXPECT_THAT(text.substr(rule).substr(0, 60), HasSubstr(fmt::format("{:.3f}", *least->sure)));
  EXPECT_THAT(text, HasSubstr("touchdown estimate run.mpack --labels labels.csv"));
}

/// A sensor of a robot's left leg fails for half a second.
TEST_F(Label, NothingIsKnownWhereSignalsAreMissing) {
  logs::Recording log = test::robot_log(4.0);
  for (std::size_t k = 1000; k < 1500; ++k) log.observation[k].servo[0].torque = std::nan("");
  logs::write_recording(log, folder_ / "robot.mpack");
  const logs::ContactIntervals labels = labels_of("robot.mpack");
  EXPECT_NE(labels.at(0.9), nullptr);
  EXPECT_EQ(labels.at(1.25), nullptr);
  EXPECT_NE(labels.at(1.6), nullptr);
}

TEST_F(Label, NeverReplacesWhatAPersonMayHaveCorrected) {
  logs::write_recording(test::robot_log(2.0), folder_ / "robot.mpack");
  folder_.output_of("estimate robot.mpack --propose labels.csv");
  folder_.output_of("estimate robot.mpack --propose labels.csv");  // the same proposal
  const std::string proposed = folder_.text("labels.csv");
  const std::string first = proposed.substr(0, proposed.find('\n') + 1);
  for (const std::string& corrected : {proposed + "# looked at\n", first, std::string()}) {
    folder_.write("labels.csv", corrected);
    folder_.expect_refusals(
        {{"estimate robot.mpack --propose labels.csv", {"labels.csv: is there already"}}});
    EXPECT_EQ(folder_.text("labels.csv"), corrected);
  }
}

TEST_F(Label, AreNoTestBeforeAPersonHasCorrectedThem) {
  logs::write_recording(test::robot_log(3.0), folder_ / "robot.mpack");
  const logs::ContactIntervals proposed = labels_of("robot.mpack");
  ASSERT_GE(proposed.intervals.size(), 3U);
  const auto is_warned = [&](const logs::ContactIntervals& labels, const std::string& more = "") {
    folder_.write("mine.csv", logs::to_csv(labels));
    const std::string text =
        folder_.output_of("estimate robot.mpack --labels mine.csv --estimator " +
                          (more.empty() ? std::string("load_filter") : more));
    EXPECT_THAT(text, HasSubstr("truth "));
    return text.find("labels       are this estimator's own decisions") != std::string::npos;
  };
  EXPECT_TRUE(is_warned(proposed));
  logs::ContactIntervals changed = proposed;
  changed.intervals.erase(changed.intervals.begin());  // the rows that stay were not looked at
  EXPECT_TRUE(is_warned(changed));
  changed = proposed;
  changed.intervals[1].contact[0] = !changed.intervals[1].contact[0];
  EXPECT_FALSE(is_warned(changed));
  changed = proposed;
  changed.intervals[1].start = changed.intervals[0].end += 0.001;
  EXPECT_FALSE(is_warned(changed));
  changed = proposed;
  for (logs::ContactInterval& one : changed.intervals) one.sure.reset();  // as the editor accepts
  EXPECT_FALSE(is_warned(changed));
  EXPECT_FALSE(is_warned(proposed, "free_fall"));
  // `--propose` beside labels writes the same decisions.
  EXPECT_THAT(folder_.output_of("estimate robot.mpack --labels labels.csv --propose again.csv"),
              HasSubstr("are this estimator's own decisions"));
  EXPECT_EQ(folder_.text("again.csv"), folder_.text("labels.csv"));
}

TEST_F(Label, ALogWhoseTimeGoesBackHasNoLabelsButItsBeliefs) {
  logs::Recording log = test::robot_log(2.0);
  for (std::size_t k = 1000; k < 2000; ++k) log.observation[k].time -= 0.9;
  logs::write_recording(log, folder_ / "robot.mpack");
  const Ended ended = folder_.run("estimate robot.mpack --propose labels.csv -o beliefs.csv");
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.errors, HasSubstr("--propose: time goes back by 0."));
  EXPECT_FALSE(folder_.has("labels.csv"));
  EXPECT_TRUE(folder_.has("beliefs.csv"));
}

TEST_F(Label, RefusesWhatItCannotLabel) {
  logs::write_recording(test::robot_log(2.0), folder_ / "robot.mpack");
  folder_.expect_refusals({{"estimate robot.mpack --propose l.csv --estimator robust", {"--model"}},
                           {"estimate robot.mpack --propose l.npz", {".csv"}},
                           {"estimate robot.mpack --propose l.csv -o l.csv", {"l.csv", "twice"}},
                           {"estimate robot.mpack --propose robot.mpack", {"robot.mpack"}}});
  EXPECT_FALSE(folder_.has("l.csv"));
}

}  // namespace
}  // namespace touchdown::cli
