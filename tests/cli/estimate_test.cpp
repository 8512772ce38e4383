#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "estimator/bayes/filter.hpp"
#include "estimator/models/metadata.hpp"
#include "experiments/estimators/fits.hpp"
#include "experiments/logs/summary.hpp"
#include "experiments/signals/estimator_runner.hpp"
#include "logs/bags/bag.hpp"
#include "logs/log/recording_file.hpp"
#include "logs/model_file.hpp"
#include "logs/signals_from.hpp"
#include "program.hpp"
#include "scoring/score.hpp"
#include "synthetic_log.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

namespace fs = std::filesystem;

using Lines = std::vector<std::vector<std::string>>;

/// The cells of a CSV without quotes, line by line, after the header.
Lines lines_of(const std::string& csv) {
  Lines lines;
  std::istringstream stream(csv);
  std::string line;
  std::getline(stream, line);
  EXPECT_EQ(line,
            "time_s,p_contact_left,p_contact_right,contact_left,contact_right,p_any_wheel,"
            "p_both_wheels,p_takeoff,p_landing,status,load_left_n,load_right_n,"
            "load_deviation_left_n,load_deviation_right_n,stamp_ns");
  while (std::getline(stream, line)) {
    std::istringstream cells(line);
    lines.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) lines.back().push_back(cell);
    EXPECT_EQ(lines.back().size(), 15U) << line;
  }
  return lines;
}

class Estimate : public InFolder {
 protected:
  Estimate() {
    const logs::Recording fitted = test::synthetic_log(3.0);
    const experiments::RunSignals run =
        experiments::signals_of(fitted, {}, {}, scoring::SampleUnit::run);
    MeasurementConfig config = BayesFilterConfig::robust().measurement;
    config.fit.knee_count = config.fit.wheel_count = 60;
    logs::save_model(
        {.grid = experiments::fit_torques(experiments::RunPointers{&run}, 0.3, config)},
        folder_ / "m.npz");
  }

  void log(const std::string& name, const logs::Recording& recording) const {
    logs::write_recording(recording, folder_ / name);
  }

  std::string estimate(const std::string& arguments) const {
    const Ended ended = folder_.run("estimate " + arguments);
    EXPECT_EQ(ended.exit_code, 0) << ended.errors;
    EXPECT_EQ(ended.errors, "");
    return ended.output;
  }

  Lines table(const std::string& name) const { return lines_of(folder_.text(name)); }

  BayesFilter filter(double rate, int window) const {
    BayesFilterConfig config = BayesFilterConfig::robust();
    config.sample_rate = rate;
    config.transition.window = window;
    return BayesFilter(*load_model(folder_ / "m.npz").grid, config);
  }

  void expect_beliefs(const Lines& lines, const logs::Recording& recording,
                      BayesFilter filter) const {
    ASSERT_EQ(lines.size(), recording.steps());
    double command = 0.0;
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const Belief& b = filter.update(logs::signals_from(recording.observation[k], command));
      command = logs::ground_velocity_command(recording.action[k]);
      const std::vector<double> expected = {recording.observation[k].time,
                                            b.wheel[0].p_contact,
                                            b.wheel[1].p_contact,
                                            b.wheel[0].contact ? 1.0 : 0.0,
                                            b.wheel[1].contact ? 1.0 : 0.0,
                                            b.p_any_wheel,
                                            b.p_both_wheels,
                                            filter.transition().contact_to_air,
                                            filter.transition().air_to_contact};
      for (std::size_t i = 0; i < expected.size(); ++i) {
        ASSERT_EQ(std::stod(lines[k][i]), expected[i]) << "line " << k << ", column " << i;
      }
      ASSERT_EQ(lines[k][9], to_text(b.status));
    }
  }
};

TEST_F(Estimate, WritesTheBeliefsOfTheLibrarysFilter) {
  // A slower log has a window of the same length.
  for (const auto& [period, window] : {std::pair{1000, 128}, {5000, 26}}) {
    const logs::Recording recording = test::synthetic_log(2.0, period);
    log("a.mpack", recording);
    const int rate = 1'000'000 / period;
    EXPECT_THAT(estimate("a.mpack --model m.npz -o b.csv"),
                AllOf(StartsWith(fmt::format("a.mpack: {} steps, 2.000 s at {} Hz, Bayes filter "
                                             "(robust)",
                                             recording.steps(), rate)),
                      HasSubstr("signals      all good")));
    expect_beliefs(table("b.csv"), recording, filter(rate, window));
  }
}

TEST_F(Estimate, RoundsAJitteringClockToItsNominalRate) {
  logs::Recording recording = test::robot_log(1.0);
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    recording.observation[k].time = 1.0007e-3 * static_cast<double>(k) + (k % 3 == 1 ? 4e-6 : 0.0);
  }
  log("a.mpack", recording);
  EXPECT_THAT(estimate("a.mpack --model m.npz -o b.csv"), HasSubstr("at 1000 Hz"));
  expect_beliefs(table("b.csv"), logs::read_recording(folder_ / "a.mpack"), filter(1000.0, 128));
  EXPECT_THAT(estimate("a.mpack --estimator nmn"), HasSubstr("NMN"));
}

TEST_F(Estimate, ScoresAgainstTheTruthAsExperimentsDo) {
  const logs::Recording recording = test::synthetic_log(3.0);
  log("a.mpack", recording);
  const experiments::RunSignals run =
      experiments::signals_of(recording, {}, {}, scoring::SampleUnit::run);
  BayesFilter scored = filter(1000.0, 128);
  const scoring::RobotScore score =
      touchdown::scoring::score(
          run.contact, experiments::predict(scored, run, experiments::noise_run(run, {}), {}), {0},
          1000, {})
          .front();
  const scoring::Score wheels = score.wheels();
  const std::string summary = estimate("a.mpack --model m.npz");
  EXPECT_THAT(summary, HasSubstr(fmt::format("accuracy {:.4f},", wheels.points.success())));
  EXPECT_THAT(summary,
              HasSubstr(fmt::format("truth        F1 of takeoffs and landings {:.4f}, extra "
                                    "switches {:.1f}/min",
                                    wheels.events.f1(), wheels.extra_switches_per_minute())));
  EXPECT_THAT(summary, HasSubstr(fmt::format("Brier {:.4f}", wheels.calibration.brier())));
  EXPECT_THAT(summary, HasSubstr("takeoffs 6 of 6 found"));
  EXPECT_THAT(summary, HasSubstr("left wheel   takeoffs at (s) 0.6"));
  log("robot.mpack", test::robot_log(1.0));
  EXPECT_THAT(estimate("robot.mpack --model m.npz"), Not(HasSubstr("truth")));
}

TEST_F(Estimate, WritesBeliefsAsABagWithTheClockOfTheLog) {
  constexpr double start = 1.7e9;  // s, as a robot's clock
  logs::Recording log = test::robot_log(2.0);
  for (models::Observation& step : log.observation) step.time += start;
  this->log("robot.mpack", log);
  estimate("robot.mpack --model m.npz -o beliefs.csv -o beliefs.mcap");
  const Lines lines = lines_of(folder_.text("beliefs.csv"));
  logs::BagReader bag(folder_ / "beliefs.mcap");
  logs::BagMessage message;
  std::size_t k = 0;
  for (; bag.next(message); ++k) {
    // Places in sensor_msgs/msg/JointState with the names left_wheel and right_wheel, in CDR.
    const auto number = [&]<typename T>(std::size_t place, T value) {
      std::memcpy(&value, message.data.data() + 4 + place, sizeof value);
      return value;
    };
    ASSERT_EQ(message.data.size(), 124U);
    EXPECT_EQ(message.data.substr(4 + 24, 10), "left_wheel");
    EXPECT_EQ(message.data.substr(4 + 40, 11), "right_wheel");
    const std::int64_t stamp = 1'000'000'000 * std::int64_t{number(0, std::int32_t{})} +
                               std::int64_t{number(4, std::uint32_t{})};
    EXPECT_EQ(stamp, message.time);
    EXPECT_EQ(std::to_string(stamp), lines.at(k)[14]);
    EXPECT_NEAR(static_cast<double>(stamp) * 1e-9, start + 1e-3 * static_cast<double>(k), 1e-6);
    for (std::size_t wheel = 0; wheel < 2; ++wheel) {
      EXPECT_EQ(number(56 + 8 * wheel, 0.0), std::stod(lines[k][1 + wheel]));
      EXPECT_EQ(number(80 + 8 * wheel, 0.0), std::stod(lines[k][3 + wheel]));
      const double load = number(104 + 8 * wheel, 0.0);
      EXPECT_EQ(fmt::format("{}", load), lines[k][10 + wheel]);
    }
  }
  EXPECT_EQ(k, lines.size());
  ASSERT_EQ(bag.topics().size(), 1U);
  EXPECT_EQ(bag.topics()[0].name, "/touchdown/contact");
  EXPECT_EQ(bag.topics()[0].type, "sensor_msgs/msg/JointState");
}

TEST_F(Estimate, ScoresAgainstLabelsIfGiven) {
  const auto truth = [&](const std::string& arguments) {
    const std::string summary = estimate(arguments + " --model m.npz");
    const std::size_t begin = summary.find("truth");
    const std::size_t end = std::min(summary.find("\nlabels"), summary.find("\nmodel"));
    return begin == std::string::npos ? "none" : summary.substr(begin, end - begin);
  };
  log("labelled.mpack", test::synthetic_log(4.0));
  log("robot.mpack", test::robot_log(4.0));
  EXPECT_EQ(truth("robot.mpack"), "none");
  folder_.write("all.csv", test::synthetic_labels(0, 4));
  EXPECT_EQ(truth("robot.mpack --labels all.csv"), truth("labelled.mpack"));
  // An interval is scored as a run: four takeoffs of wheels in two seconds.
  folder_.write("middle.csv", test::synthetic_labels(1, 3));
  EXPECT_THAT(truth("robot.mpack --labels middle.csv"), HasSubstr("takeoffs 4 of 4 found"));
  // Labels take precedence over the log's own ground truth.
  folder_.write("hangs.csv", "start,end,contact\n0,4,0\n");
  EXPECT_THAT(truth("labelled.mpack --labels hangs.csv"), HasSubstr("takeoffs 0 of 0 found"));
}

TEST_F(Estimate, StatesHowMuchOfALogItsLabelsCover) {
  log("robot.mpack", test::robot_log(4.0));
  const auto labelled = [&](int start, int end) {
    folder_.write("l.csv", test::synthetic_labels(start, end));
    return estimate("robot.mpack --model m.npz --labels l.csv");
  };
  EXPECT_THAT(labelled(0, 4), Not(HasSubstr("labels  ")));
  EXPECT_THAT(labelled(1, 3), HasSubstr("labels       cover 50.0 % of the steps"));
  EXPECT_THAT(labelled(3, 4), HasSubstr("labels       cover 25.0 % of the steps"));
  logs::Recording light = test::synthetic_log(4.0);
  light.info.robot_mass = 0.3;  // kg
  log("light.mpack", light);
  EXPECT_THAT(estimate("light.mpack --model m.npz"),
              HasSubstr("labels       contact is a normal force above 0.056 N, 0.019 of the "));
  folder_.write("before.csv", "start,end,contact\n-5,-3,1\n-2,-1,0\n");
  folder_.write("behind.csv", "start,end,contact\n4.1,4.9,1\n");
  folder_.expect_refusals(
      {{"estimate robot.mpack --labels before.csv -o x.csv",
        {"before.csv: none of its intervals, from -5.000 to -1.000 s, covers a step of robot."}},
       {"estimate robot.mpack --labels behind.csv -o x.csv", {"behind.csv: none of its"}}});
  EXPECT_FALSE(folder_.has("x.csv"));
}

TEST_F(Estimate, StatesThatLabelsKnowNoLoadInContact) {
  log("robot.mpack", test::robot_log(4.0));
  log("simulated.mpack", test::synthetic_log(4.0));
  folder_.write("l.csv", test::synthetic_labels(0, 4));
  constexpr const char* of_air = "load         where labels state no contact: median error ";
  EXPECT_THAT(estimate("robot.mpack --labels l.csv"), HasSubstr(of_air));
  // … where the log itself knows it everywhere
  const std::string own = estimate("simulated.mpack");
  const auto load_of = [](const std::string& text) { return text.substr(text.find("\nload ")); };
  EXPECT_EQ(load_of(estimate("simulated.mpack --labels l.csv")), load_of(own));
}

TEST_F(Estimate, WritesBeliefsIntoTheLogAndKeepsTheRest) {
  log("a.mpack", test::synthetic_log(0.5));
  estimate("a.mpack --model m.npz -o b.mpack -o b.csv");
  const Lines lines = table("b.csv");
  std::istringstream before(read_file(folder_ / "a.mpack"));
  std::istringstream after(read_file(folder_ / "b.mpack"));
  for (const auto& line : lines) {
    const auto old = nlohmann::json::from_msgpack(before, false);
    auto record = nlohmann::json::from_msgpack(after, false);
    const auto filter = record["observation"]["contact_filter"];
    EXPECT_EQ(filter["p_contact"].get<double>(), std::stod(line[1]));
    EXPECT_EQ(filter["right_wheel"]["p_contact"].get<double>(), std::stod(line[2]));
    EXPECT_EQ(record["observation"]["transition_model"]["p_takeoff_p_switch"].get<double>(),
              std::stod(line[7]));
    for (const char* key : {"contact_filter", "measurement_model", "transition_model"}) {
      EXPECT_EQ(record["observation"].erase(key), 1U);
    }
    // As bytes, because NaN is not equal to itself.
    EXPECT_EQ(nlohmann::json::to_msgpack(record), nlohmann::json::to_msgpack(old));
  }
  EXPECT_EQ(after.peek(), std::char_traits<char>::eof());
}

TEST_F(Estimate, ReportsUnusableSignals) {
  logs::Recording broken = test::synthetic_log(1.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 400; k < 410; ++k) broken.observation[k].servo[1].torque = nan;
  broken.observation[420].imu.linear_acceleration.z() = nan;
  for (std::size_t k = 700; k < broken.steps(); ++k) broken.observation[k].time += 0.5;
  log("a.mpack", broken);
  EXPECT_THAT(estimate("a.mpack --model m.npz -o b.csv"),
              HasSubstr("11 invalid, 1 gap of 1000 steps"));
  const Lines lines = table("b.csv");
  ASSERT_EQ(lines.size(), 1000U);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const bool invalid = (k >= 400 && k < 410) || k == 420;
    EXPECT_EQ(lines[k][9], invalid ? "invalid" : k == 700 ? "gap" : "good") << k;
    for (std::size_t i = 0; i < 9; ++i) EXPECT_TRUE(std::isfinite(std::stod(lines[k][i])));
  }
}

TEST_F(Estimate, ReportsTheLogsTimesGapsAndStepsBack) {
  logs::Recording robot = test::robot_log(1.0);
  for (std::size_t k = 0; k < robot.steps(); ++k) {
    robot.observation[k].time += 10.0 + (k >= 700 ? 0.5 : 0.0);
  }
  log("lost.mpack", robot);
  EXPECT_THAT(estimate("lost.mpack --model m.npz"),
              HasSubstr("time         from 10.000 to 11.499 s; 0.500 s without records\n"));
  // A clock that is set back draws over what it drew before, from the earliest time on.
  for (std::size_t k = 700; k < robot.steps(); ++k) robot.observation[k].time -= 2.5;
  log("back.mpack", robot);
  const Ended back = folder_.run("estimate back.mpack --model m.npz --figure fig.png");
  EXPECT_EQ(back.exit_code, 0);
  EXPECT_EQ(
      back.errors,
      "touchdown: back.mpack: time: goes back once, by up to 2 s: sort the log, or split it\n");
  EXPECT_THAT(back.output, HasSubstr("time         from 8.700 to 10.699 s; it goes back 1 time\n"));
  EXPECT_THAT(folder_.text("fig.gp"), HasSubstr("set xrange [8.7:10.69"));
  experiments::LogSummary summary(0.001, {});
  EXPECT_THAT(summary.text({}), StartsWith("time         no finite value\n"));
  summary.add(0.0, {});
  EXPECT_THAT(
      summary.text({}, 1234.5),
      StartsWith("time         from 0.000 to 0.000 s, 0 being 1234.500 s of the log's clock\n"));
}

TEST_F(Estimate, OfATruncatedLogKeepsTheReadStepsAndReportsTheEnd) {
  log("whole.mpack", test::synthetic_log(0.5));
  const std::string whole = read_file(folder_ / "whole.mpack");
  folder_.write("cut.mpack", whole.substr(0, whole.size() - 10));
  estimate("whole.mpack --model m.npz -o whole.csv");
  const std::string warning = folder_.messages_of("estimate cut.mpack --model m.npz -o cut.csv");
  EXPECT_THAT(warning, AllOf(HasSubstr("cut.mpack: byte "), HasSubstr("cut off")));
  EXPECT_EQ(std::count(warning.begin(), warning.end(), '\n'), 1);
  Lines expected = table("whole.csv");
  expected.pop_back();
  EXPECT_EQ(table("cut.csv"), expected);
}

TEST_F(Estimate, OfSeveralLogsNamesEachResultAfterItsLog) {
  log("a.mpack", test::synthetic_log(0.4));
  log("b.mpack", test::synthetic_log(0.5));
  estimate("a.mpack b.mpack --model m.npz -o out/x.csv");
  EXPECT_EQ(table("out/a_x.csv").size(), 400U);
  EXPECT_EQ(table("out/b_x.csv").size(), 500U);
}

TEST_F(Estimate, OfLogsWithEqualNamesAddsTheFoldersThatTellThemApart) {
  for (const char* folder : {"s1/x", "s1/y", "s2/x", "s3", "s3/run_1.0", "s3/run_1.5"}) {
    fs::create_directories(folder_ / folder);
    log(fmt::format("{}/robot.mpack", folder), test::synthetic_log(0.4));
  }
  log("s3/other.mpack", test::synthetic_log(0.4));
  const std::string own = folder_.path().filename().string();
  log("robot.mpack", test::synthetic_log(0.4));
  const auto expect_named = [&](const std::string& logs, const std::vector<std::string>& names) {
    estimate(logs + " --model m.npz -o out/b.csv --propose out/p.csv");
    for (const std::string& name : names) {
      EXPECT_TRUE(folder_.has("out/" + name + "_b.csv")) << logs << ": " << name;
      EXPECT_TRUE(folder_.has("out/" + name + "_p.csv")) << logs << ": " << name;
    }
    EXPECT_EQ(entries_in(folder_ / "out").size(), 2 * names.size()) << logs;
    fs::remove_all(folder_ / "out");
  };
  expect_named("s1/x/robot.mpack s1/y/robot.mpack", {"x_robot", "y_robot"});
  expect_named("s1/x/robot.mpack ./s2/x/robot.mpack s3/other.mpack",
               {"s1_robot", "s2_robot", "other"});
  expect_named("s1/x/robot.mpack s1/y/robot.mpack s2/x/robot.mpack",
               {"s1_x_robot", "y_robot", "s2_x_robot"});
  expect_named("robot.mpack s3/robot.mpack", {own + "_robot", "s3_robot"});
  expect_named("s3/run_1.0/robot.mpack s3/run_1.5/robot.mpack", {"run_1.0_robot", "run_1.5_robot"});
  folder_.expect_refusals(
      {{"estimate s3/robot.mpack s1/../s3/robot.mpack --model m.npz -o b.csv",
        {"robot_b.csv: would be written twice, for s3/robot.mpack and s1/../s3/robot.mpack"}},
       {"estimate s3/robot.mpack s3/other.mpack --model m.npz -o b.csv --propose b.csv",
        {"robot_b.csv: would be written twice: name another file"}}});
}

TEST_F(Estimate, RecognizesTheEstimatorOfAModel) {
  log("a.mpack", test::synthetic_log(3.0));
  folder_.output_of("fit a.mpack -o p.npz --estimator paper --grid 60 60 --no-accuracy");
  EXPECT_THAT(estimate("a.mpack --model p.npz"), HasSubstr("Bayes filter (paper)"));
  EXPECT_THAT(estimate("a.mpack --model p.npz --estimator paper_rms"), HasSubstr("truth"));
  for (const std::string name : {"lode", "evidence_curves"}) {
    logs::write_npz({{std::string(estimator_array), array_of_text(name)}, {"slope", {{1}, {1.0}}}},
                    folder_ / (name + ".npz"));
  }
  std::vector<Refusal> refusals = {
      {"--model p.npz --estimator robust",
       {"p.npz: is a model of 'paper', which 'robust' cannot use", "--estimator paper?"}},
      {"--model m.npz --estimator load_filter",
       {"m.npz: is a model of 'robust', which 'load_filter' cannot use"}},
      {"--model lode.npz", {"lode.npz: ", "'lode'"}},
      {"--model evidence_curves.npz", {"was fitted for 'evidence_curves'", "load_filter"}}};
  for (Refusal& refusal : refusals) refusal.arguments.insert(0, "estimate a.mpack ");
  folder_.expect_refusals(refusals);
}

/// Without a model, an estimator's name, or targets of joints in the log.
TEST_F(Estimate, IsByTheLoadFilterUnlessAnotherIsNamed) {
  log("a.mpack", test::synthetic_log(3.0));
  const std::string summary = estimate("a.mpack -o b.csv");
  EXPECT_THAT(summary, AllOf(HasSubstr("at 1000 Hz, Load filter"), HasSubstr("6 of 6 found"),
                             HasSubstr("load         median error")));
  const Lines lines = table("b.csv");
  EXPECT_EQ(lines.back()[7], "nan") << "it has no transition model";
  // Upkie stands on both wheels at 0.5 s and flies at 0.7 s.
  for (const auto& [step, load] : {std::pair{500U, test::half_weight}, {700U, 0.0}}) {
    for (const std::size_t wheel : {0U, 1U}) {
      EXPECT_NEAR(std::stod(lines[step][10 + wheel]), load, 3.0) << step;
    }
  }
  EXPECT_EQ(estimate("a.mpack --estimator load_filter"), estimate("a.mpack"));
  EXPECT_NE(estimate("a.mpack --set lead=0"), estimate("a.mpack"));
}

TEST_F(Estimate, DrawsTheRequestedPartOfTheLog) {
  log("a.mpack", test::synthetic_log(1.0));
  EXPECT_THAT(estimate("a.mpack --model m.npz --figure fig.png --from 0.4999 --to 0.7001"),
              HasSubstr("figure       fig.png"));
  const std::string data = folder_.text("fig.dat");
  EXPECT_EQ(std::count(data.begin(), data.end(), '\n'), 202);  // 0.5, 0.501, …, 0.7 and a header
  EXPECT_TRUE(folder_.has("fig.svg"));
}

/// On a full disk, gnuplot writes nothing and ends with exit code 0.
TEST_F(Estimate, AFigureOnAFullDiskIsAnErrorAndKeepsTheOldOne) {
  log("a.mpack", test::synthetic_log(1.0));
  estimate("a.mpack --model m.npz --figure fig.png");
  const std::string before = folder_.text("fig.pdf");
  folder_.write("bin/gnuplot", "#!/bin/sh\n: >fig.png; : >fig.svg; : >fig.pdf\n");
  fs::permissions(folder_ / "bin/gnuplot", fs::perms::owner_all);
  const Ended ended = folder_.execute("estimate a.mpack --model m.npz --figure fig.png --from 0.5",
                                      "PATH=\"$PWD/bin:$PATH\" &&");
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.errors, HasSubstr("fig.png: cannot be written"));
  EXPECT_EQ(std::count(ended.errors.begin(), ended.errors.end(), '\n'), 1) << ended.errors;
  EXPECT_TRUE(folder_.text("fig.pdf") == before);
  for (const auto& entry : fs::directory_iterator(folder_.path())) {
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
  }
}

TEST_F(Estimate, AnswersWrongRequestsInOneLine) {
  log("a.mpack", test::synthetic_log(0.1));
  log("slow.mpack", test::synthetic_log(2.0, 20000));
  folder_.write("b.mpack", "name: stairs\n");
  folder_.write("hangs.csv", "start,end,contact\n0,4,0\n");
  folder_.expect_refusals(
      {{"estimate a.mpack --model m.npz --estimator robst", {"did you mean 'robust'?"}},
       {"estimate a.mpack --estimator robust", {"--model is missing"}},
       {"estimate a.mpack --model x.npz", {"x.npz"}},
       {"estimate a.mpack --model a.mpack", {"a.mpack"}},
       {"estimate a.mpack --estimator free_fall --model m.npz", {"takes none"}},
       {"estimate a.mpack --estimator oracle", {"ground truth"}},
       {"estimate a.mpack --model m.npz -o b.txt", {".csv"}},
       {"estimate a.mpack --model m.npz -o b.csv -o c.csv", {"one kind"}},
       {"estimate a.mpack --model m.npz -o a.mpack", {"the log itself"}},
       {"estimate a.mpack --model m.npz --labels hangs.csv -o hangs.csv", {"hangs.csv"}},
       {"estimate a.mpack a.mpack --model m.npz -o b.csv", {"b.csv", "twice"}},
       {"estimate a.mpack --model m.npz --figure b.jpg", {".png"}},
       {"estimate a.mpack --model m.npz --figure none.png --from 5", {"no step between"}},
       {"estimate a.mpack --model m.npz --figure none.png --from 0.05 --to 0.02",
        {"--to: 0.02 s is before --from, 0.05 s"}},
       {"estimate a.mpack --model m.npz -o b.csv --from 3 --to 2", {"expected --figure"}},
       {"estimate a.mpack --model m.npz -o b.csv --to 0.05", {"expected --figure"}},
       {"estimate a.mpack --model m.npz --set leave_below=0.05 --set leave_below=0.06",
        {"'leave_below' is set twice"}},
       {"convert m.npz -o m.hpp --set leave_below=0.1 --set leave_below=0.2",
        {"'leave_below' is set twice"}},
       {"estimate a.mpack - --model m.npz", {"alone"}},
       {"estimate missing.mpack --model m.npz", {"missing.mpack"}},
       {"estimate b.mpack --model m.npz -o b.csv", {"b.mpack: byte 0"}},
       {"estimate slow.mpack --model m.npz",
        {"slow.mpack: 50 steps per second: expected 100 to 20000"}}});
  EXPECT_FALSE(folder_.has("b.csv"));
}

}  // namespace
}  // namespace touchdown::cli
