#include <algorithm>
#include <limits>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/estimators/fits.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/signals/run_signals.hpp"
#include "logs/log/contact_intervals.hpp"
#include "logs/log/recording_file.hpp"
#include "logs/model_file.hpp"
#include "program.hpp"
#include "synthetic_log.hpp"

namespace touchdown::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

namespace fs = std::filesystem;

class Fit : public InFolder {
 protected:
  fs::path log(const std::string& name, const logs::Recording& recording) const {
    logs::write_recording(recording, folder_ / name);
    return folder_ / name;
  }

  std::string fit(const std::string& arguments) const {
    return folder_.output_of("fit " + arguments);
  }

  experiments::RunSignals signals_of_log(const std::string& name) const {
    return experiments::signals_of(logs::read_recording(folder_ / name), {}, {},
                                   scoring::SampleUnit::run);
  }

  /// Every request is refused, and no model is written.
  void expect_refusals(std::vector<Refusal> refusals) const {
    for (Refusal& refusal : refusals) refusal.arguments.insert(0, "fit ");
    folder_.expect_refusals(refusals);
    EXPECT_FALSE(folder_.has("m.npz"));
  }
};

void expect_same(const MeasurementModel& a, const MeasurementModel& b) {
  const LikelihoodGrids x = a.grids();
  const LikelihoodGrids y = b.grids();
  EXPECT_NEAR(x.knee.upper, y.knee.upper, 1e-9);
  EXPECT_NEAR(x.wheel.lower, y.wheel.lower, 1e-9);
  ASSERT_EQ(x.contact.size(), y.contact.size());
  const double largest = *std::max_element(y.contact.begin(), y.contact.end()) +
                         *std::max_element(y.no_contact.begin(), y.no_contact.end());
  for (std::size_t i = 0; i < x.contact.size(); ++i) {
    ASSERT_NEAR(x.contact[i], y.contact[i], 1e-9 * largest) << i;
    ASSERT_NEAR(x.no_contact[i], y.no_contact[i], 1e-9 * largest) << i;
  }
}

TEST_F(Fit, OfLabelledLogsEqualsTheFitOfExperiments) {
  log("a.mpack", test::synthetic_log(4.0));
  log("b.mpack", test::synthetic_log(2.5));
  for (const std::string name : {"robust", "reference", "paper", "measurement_only"}) {
    EXPECT_THAT(fit("a.mpack b.mpack -o m.npz --no-accuracy --estimator " + name),
                HasSubstr("2 logs"));
    const experiments::RunSignals a = signals_of_log("a.mpack");
    const experiments::RunSignals b = signals_of_log("b.mpack");
    const Model written = load_model(folder_ / "m.npz");
    expect_same(*written.grid, experiments::fit_torques(
                                   experiments::RunPointers{&a, &b}, 0.3,
                                   experiments::estimator_entry(name).fitting.torques.value()));
    EXPECT_THAT(text_of_array(written.arrays.at("provenance"), "provenance"),
                HasSubstr("seed:run: 5:0\n"));
  }
}

TEST_F(Fit, ToCorrectLabelsEqualsTheFitToTheTruth) {
  log("with_truth.mpack", test::synthetic_log(3.0));
  log("robot.mpack", test::synthetic_log(3.0, 1000, false));
  folder_.write("robot.csv", test::synthetic_labels(0, 3));
  const std::string to_truth = fit("with_truth.mpack -o m.npz --estimator robust");
  const Model expected = load_model(folder_ / "m.npz");
  EXPECT_EQ(fit("robot.mpack --labels robot.csv -o m.npz --estimator robust"), to_truth)
      << "as many samples, the same bandwidths";
  expect_same(*load_model(folder_ / "m.npz").grid, *expected.grid);
}

TEST_F(Fit, LeavesOutUnlabelledSteps) {
  log("robot.mpack", test::robot_log(4.0));
  folder_.write("robot.csv", test::synthetic_labels(1, 3));
  EXPECT_THAT(fit("robot.mpack --labels robot.csv -o f.npz"), HasSubstr("2.000 s of 1 log"));
  folder_.write("late.csv", test::synthetic_labels(7, 8));
  folder_.write("long.csv", test::synthetic_labels(1, 8));
  folder_.write("behind.csv", "start,end,contact\n4.1,4.9,1\n");
  expect_refusals({{"robot.mpack --labels late.csv -o m.npz",
                    {"late.csv: none of its intervals, from 7.000 to 8.000 s, covers a step"}},
                   {"robot.mpack --labels long.csv -o m.npz",
                    {"long.csv: its last interval ends at 8.000 s, and robot.mpack at 3.999 s"}},
                   {"robot.mpack --labels behind.csv -o m.npz",
                    {"s, covers a step of robot.mpack, which ends at 3.999 s"}},
                   {"robot.mpack robot.mpack --labels robot.csv -o m.npz",
                    {"a file for each log, in their order: 1 for 2"}},
                   {"robot.mpack --labels robot.csv -o robot.csv", {"robot.csv"}}});
}

/// Labels at other times, of the other class, in another unit.
TEST_F(Fit, NamesLabelsThatContradictTheLoadOfTheTorques) {
  log("robot.mpack", test::robot_log(6.0));
  folder_.write("good.csv", test::synthetic_labels(0, 6));
  const logs::ContactIntervals good = logs::read_contact_intervals(folder_ / "good.csv");
  const auto labels = [&](double scale, double shift, bool exchanged) {
    logs::ContactIntervals changed = good;
    for (logs::ContactInterval& one : changed.intervals) {
      one.start = scale * one.start + shift;
      one.end = scale * one.end + shift;
      if (exchanged) one.contact = {!one.contact[0], !one.contact[1]};
    }
    return logs::to_csv(changed);
  };
  std::string alternating = "start,end,contact\n";
  for (int i = 0; i < 16; ++i) {
    alternating += fmt::format("{},{},{}\n", 0.37 * i, 0.37 * (i + 1), i % 2);
  }
  const std::vector<std::pair<std::string, std::string>> cases = {
      {labels(1.0, 0.0, false), ""},
      {labels(1.0, 0.02, false), ""},
      {labels(1.0, 0.0, true), "contact, and 0 exchanged?"},
      {labels(1.0, 0.4, false), "if they come 0.4 s earlier"},
      {labels(1.0, -0.2, false), "if they come 0.2 s later"},
      {alternating, "those of another log"},
  };
  for (const auto& [text, cause] : cases) {
    folder_.write("labels.csv", text);
    for (const std::string verb : {"fit -o f.npz --no-accuracy ", "estimate "}) {
      const Ended ended = folder_.run(verb + "robot.mpack --labels labels.csv");
      EXPECT_EQ(ended.exit_code, 0);
      EXPECT_EQ(ended.errors.empty(), cause.empty()) << verb << ended.errors;
      EXPECT_THAT(ended.errors, HasSubstr(cause)) << verb;
    }
  }
  folder_.write("labels.csv", labels(1e3, 0.0, false));
  expect_refusals({{"robot.mpack --labels labels.csv -o m.npz", {"are they another unit"}}});
  EXPECT_THAT(folder_.refusal_of("estimate robot.mpack --labels labels.csv"),
              HasSubstr("are they another unit"));
}

TEST_F(Fit, NamesExchangedClassesOfWholeLogs) {
  log("rolling.mpack", test::one_class_log(2.0, true));
  log("hanging.mpack", test::one_class_log(2.0, false));
  const auto errors = [&](const std::string& contact, const std::string& no_contact) {
    return folder_
        .run("fit -o f.npz --no-accuracy --contact " + contact + " --no-contact " + no_contact)
        .errors;
  };
  EXPECT_THAT(errors("rolling.mpack", "hanging.mpack"), IsEmpty());
  EXPECT_THAT(errors("hanging.mpack", "rolling.mpack"), HasSubstr("are they exchanged?"));
}

TEST_F(Fit, ShowsItsProgressOnLargeLogs) {
  log("robot.mpack", test::synthetic_log(25.0));
  const std::string errors = folder_.run("fit robot.mpack -o f.npz").errors;
  for (const char* stage : {"fitting: ", "judging: ", "scoring: "}) {
    EXPECT_THAT(errors, HasSubstr(stage));
  }
}

TEST_F(Fit, ItsLogsAreNoTestOfTheModelAndCountOnce) {
  log("a.mpack", test::robot_log(3.0));
  log("b.mpack", test::robot_log(3.5));
  folder_.write("labels.csv", test::synthetic_labels(0, 3));
  folder_.write("copy.mpack", folder_.text("a.mpack"));
  fit("a.mpack --labels labels.csv -o fitted.npz");
  const std::string no_test = "it was fitted to this log";
  for (const std::string log : {"a.mpack", "copy.mpack"}) {
    EXPECT_THAT(folder_.output_of("estimate --model fitted.npz " + log), HasSubstr(no_test)) << log;
  }
  EXPECT_THAT(folder_.run("estimate --model fitted.npz - < a.mpack").errors, HasSubstr(no_test));
  EXPECT_THAT(folder_.output_of("estimate --model fitted.npz b.mpack"), Not(HasSubstr(no_test)));
  expect_refusals({{"a.mpack copy.mpack --labels labels.csv labels.csv -o m.npz",
                    {"a.mpack and copy.mpack are copies of one log"}}});
}

TEST_F(Fit, JudgesTheModelOnItsLogsAndOnOthers) {
  log("a.mpack", test::synthetic_log(3.0));
  log("b.mpack", test::synthetic_log(4.0));
  log("hanging.mpack", test::one_class_log(2.0, false));
  const std::string text = fit("a.mpack b.mpack -o m.npz --estimator robust");
  // What `estimate` counts on the log that the other model was not fitted to, by its steps: a fifth
  // of each second is in the air in both logs.
  const auto right = [&](const std::string& fitted, const std::string& log) {
    fit(fitted + " -o other.npz --estimator robust");
    return folder_.output_of("estimate " + log + " --model other.npz");
  };
  const auto number = [](const std::string& from, const std::string& after) {
    const std::size_t at = from.find(after);
    return at == std::string::npos ? NAN : std::stod(from.substr(at + after.size()));
  };
  const std::string on_a = right("b.mpack", "a.mpack");
  const std::string on_b = right("a.mpack", "b.mpack");
  const double held_out =
      (2.7 * number(on_a, "balanced accuracy ") + 3.7 * number(on_b, "balanced accuracy ")) / 6.4;
  EXPECT_NEAR(number(text, "on these logs, "), held_out, 2e-3) << text;
  EXPECT_THAT(text, HasSubstr("on each by a model of the others"));
  const double unfitted =
      (2.7 * number(folder_.output_of("estimate a.mpack"), "balanced accuracy ") +
       3.7 * number(folder_.output_of("estimate b.mpack"), "balanced accuracy ")) /
      6.4;
  const std::size_t line = text.find(" of load_filter, without a fit");
  ASSERT_NE(line, std::string::npos) << text;
  EXPECT_NEAR(std::stod(text.substr(line - 6, 6)), unfitted, 2e-3) << text;
  EXPECT_THAT(fit("a.mpack -o m.npz --estimator robust"), HasSubstr("no part can be left out"));
  EXPECT_THAT(fit("a.mpack --no-contact hanging.mpack -o m.npz --estimator robust"),
              HasSubstr("no part can be left out"));
}

TEST_F(Fit, IsJudgedOnEveryOtherPartWhereTheOtherLogsLackAClass) {
  log("rolling.mpack", test::one_class_log(25.0, true));
  log("hanging.mpack", test::one_class_log(25.0, false));
  const Ended ended = folder_.run(
      "fit --contact rolling.mpack --no-contact hanging.mpack -o m.npz --estimator robust");
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.output, HasSubstr("1.0000 on every other 10 s by a model of the rest"));
  EXPECT_THAT(ended.output, HasSubstr("of load_filter, without a fit, on these logs"));
}

TEST_F(Fit, UsesLogsOfOneClassAsDeclared) {
  const logs::Recording rolling = test::one_class_log(2.0, true);
  const logs::Recording hanging = test::one_class_log(1.0, false);
  log("rolling.mpack", rolling);
  log("hanging.mpack", hanging);
  fit("--contact rolling.mpack --no-contact hanging.mpack -o m.npz --grid 80 60 --skip 0.1");
  MeasurementConfig config = BayesFilterConfig::robust().measurement;
  config.fit.knee_count = 80;
  config.fit.wheel_count = 60;
  const auto samples = [&](const logs::Recording& recording) {
    std::vector<TorqueSample> all;
    for (const Side side : {Side::left, Side::right}) {
      TorqueChannel channel(config.torque, side, 1000.0);
      for (std::size_t k = 0; k < recording.steps(); ++k) {
        const auto& servo = recording.observation[k].servo;
        const std::size_t first = side == Side::left ? 0 : 3;
        const TorqueSample sample = channel.update(
            {{}, {0.0, 0.0, servo[first + 1].torque}, {0.0, 0.0, servo[first + 2].torque}});
        if (k >= 100) all.push_back(sample);
      }
    }
    return all;
  };
  expect_same(*load_model(folder_ / "m.npz").grid,
              fit_measurement_model(samples(rolling), samples(hanging), config.fit));
  log("both.mpack", test::synthetic_log(2.0));
  EXPECT_THAT(fit("both.mpack --contact rolling.mpack -o b.npz --no-accuracy"),
              HasSubstr("2 logs"));
}

TEST_F(Fit, RefusesLabelsThatTheLogsOwnTruthContradicts) {
  const auto with_truth = [](logs::Recording recording, double force) {
    logs::Recording simulated = test::synthetic_log(2.0);
    for (models::GroundTruth& truth : simulated.truth) truth.wheel_normal_force = {force, force};
    recording.truth = simulated.truth;
    recording.info = simulated.info;
    return recording;
  };
  log("rolling.mpack", with_truth(test::one_class_log(2.0, true), 26.0));
  log("hanging.mpack", with_truth(test::one_class_log(2.0, false), 0.0));
  expect_refusals(
      {{"--contact hanging.mpack --no-contact rolling.mpack -o m.npz",
        {"hanging.mpack: is declared --contact, but its own ground truth contradicts this for "
         "100.0 % of the steps",
         "swapped?"}}});
  fit("--contact rolling.mpack --no-contact hanging.mpack -o m.npz");
}

TEST_F(Fit, RefusesADeclaredLogThatItsTruthContradictsAtMoreThanMoments) {
  log("hanging.mpack", test::one_class_log(2.0, false));
  const auto with_air = [&](double share, double first) {
    logs::Recording recording = test::synthetic_log(4.0);
    for (std::size_t k = 0; k < recording.steps(); ++k) {
      const double time = 1e-3 * static_cast<double>(k);
      const bool air = time >= first && time < first + share * (4.0 - 0.3);
      for (double& force : recording.truth[k].wheel_normal_force) force = air ? 0.0 : 26.0;
    }
    log("rolling.mpack", recording);
  };
  for (const auto& [share, first, percent] :
       {std::tuple{0.12, 1.0, "12.0 %"}, {0.03, 2.5, "3.0 %"}, {0.4, 0.5, "40.0 %"}}) {
    with_air(share, first);
    expect_refusals({{"--contact rolling.mpack --no-contact hanging.mpack -o m.npz",
                      {fmt::format("contradicts this for {} of the steps, first at {:.3f} s: name "
                                   "it without --contact",
                                   percent, first)}}});
  }
  with_air(0.01, 1.0);
  fit("--contact rolling.mpack --no-contact hanging.mpack -o m.npz");
  with_air(0.05, 0.0);  // its beginning is not used
  fit("--contact rolling.mpack --no-contact hanging.mpack --skip 1 -o m.npz");
}

TEST_F(Fit, NamesFlightsThatTheLoadsShowInALogDeclaredInContact) {
  log("hanging.mpack", test::one_class_log(4.0, false));
  log("rolling.mpack", test::one_class_log(4.0, true));
  log("flying.mpack", test::robot_log(4.0));
  const auto errors = [&](const std::string& contact) {
    return folder_.run("fit --contact " + contact + " --no-contact hanging.mpack -o m.npz").errors;
  };
  EXPECT_THAT(errors("flying.mpack"),
              AllOf(HasSubstr("flying.mpack: is declared --contact, and the loads of its wheels "),
                    HasSubstr(" flights of a wheel")));
  EXPECT_THAT(errors("rolling.mpack"), Not(HasSubstr("is declared --contact")));
}

TEST_F(Fit, LeavesOutTorquesThatAreNotFinite) {
  logs::Recording broken = test::synthetic_log(3.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 1000; k < 1010; ++k) broken.observation[k].servo[1].torque = nan;
  broken.observation[2000].servo[5].torque = std::numeric_limits<double>::infinity();
  log("a.mpack", broken);
  const Ended ended = folder_.run("fit a.mpack -o m.npz --no-accuracy");
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.errors, HasSubstr("11 samples of a leg are not finite"));
  EXPECT_THAT(ended.output, HasSubstr("samples of both legs"));
  load_model(folder_ / "m.npz");  // throws if a number in it is none
}

TEST_F(Fit, OfATruncatedLogUsesTheCompleteSteps) {
  log("a.mpack", test::synthetic_log(3.0));
  const std::string whole = folder_.text("a.mpack");
  folder_.write("cut.mpack", whole.substr(0, whole.size() - 100));
  const Ended ended = folder_.run("fit cut.mpack -o m.npz --no-accuracy");
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.errors, AllOf(HasSubstr("cut.mpack: byte "), HasSubstr("cut off")));
  EXPECT_EQ(std::count(ended.errors.begin(), ended.errors.end(), '\n'), 1);
  EXPECT_THAT(ended.output, HasSubstr("2.699 s of 1 log"));
}

TEST_F(Fit, ReadsALogFromStandardInput) {
  log("a.mpack", test::synthetic_log(3.0));
  fit("a.mpack -o file.npz --no-accuracy");
  fit("- -o input.npz < a.mpack");
  EXPECT_TRUE(folder_.text("file.npz") == folder_.text("input.npz"));
}

TEST_F(Fit, AnswersWrongRequestsInOneLine) {
  log("a.mpack", test::synthetic_log(1.0));
  log("robot.mpack", test::robot_log(1.0));
  log("rolling.mpack", test::one_class_log(1.0, true));
  folder_.write("b.mpack", "name: stairs\n");
  expect_refusals(
      {{"a.mpack -o m.npz --estimator robst", {"did you mean 'robust'?"}},
       {"a.mpack -o m.npz --estimator load_filter", {"'load_filter' is not fitted", "robust"}},
       {"a.mpack -o m.npz --estimator nmn", {"touchdown train"}},
       {"-o m.npz", {"a log is missing"}},
       {"a.mpack", {"--output"}},
       {"missing.mpack -o m.npz", {"missing.mpack"}},
       {"b.mpack -o m.npz", {"b.mpack: byte 0"}},
       {"a.mpack -o m.npz --knee-range 3 1", {"--knee-range"}},
       {"a.mpack -o m.npz --bandwidth -1 1", {"--bandwidth"}},
       {"robot.mpack -o m.npz", {"robot.mpack: at 0.000 s: no ground truth", "--contact"}},
       {"--contact rolling.mpack -o m.npz", {"no step of the logs is without contact"}},
       {"--no-contact rolling.mpack -o m.npz", {"no step of the logs is in contact"}}});
  // Numbers that would be ignored.
  for (const std::string flag : {"--skip 1e308", "--skip -1", "--skip 1e6", "--label-window 1e300",
                                 "--label-window 1.1", "--label-share 2"}) {
    expect_refusals({{"a.mpack -o m.npz " + flag,
                      {flag.substr(0, flag.find(' ')), "expected a number from 0 to 1"}}});
  }
}

TEST_F(Fit, RefusesRunsOfReservedSeeds) {
  logs::Recording reserved = test::synthetic_log(2.0);
  reserved.info.seed = 900'000'001;
  log("a.mpack", reserved);
  expect_refusals(
      {{"a.mpack -o m.npz", {"reserved"}}, {"--contact a.mpack -o m.npz", {"reserved"}}});
}

}  // namespace
}  // namespace touchdown::cli
