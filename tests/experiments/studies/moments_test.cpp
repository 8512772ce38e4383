#include "experiments/studies/moments.hpp"

#include <cmath>
#include <map>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/table.hpp"
#include "experiments/run_directory/own_files.hpp"
#include "noise/gaussian.hpp"
#include "tests/experiments/studies/study_test.hpp"

namespace touchdown::experiments {
namespace {

using ::testing::HasSubstr;

/// Four steps of 1 ms; the left wheel is in the air at the third, the right one always in contact.
RunSignals four_steps() {
  RunSignals run;
  run.info.control_period_us = 1000;
  const std::array<double, 4> knee = {1.0, -3.0, 0.5, 2.0};
  for (const double torque : knee) {
    Signals signals;
    signals.time = 0.001 * static_cast<double>(run.signals.size());
    signals.leg[0].knee.torque = torque;
    signals.leg[0].wheel.torque = -0.1 * torque;
    signals.leg[1].knee.torque = -6.0;
    run.signals.push_back(signals);
  }
  run.contact = {scoring::ContactSequence{1, 1, 0, 1}, scoring::ContactSequence{1, 1, 1, 1}};
  return run;
}

TEST(TorqueMoments, OfAFewStepsAreThoseByHand) {
  TorqueSegments segments;
  add_torques(four_steps(), 0.0, segments);
  // In contact the left knee has 1, 3, 2 and the right one 6 four times.
  const TorqueDistribution knee = distribution_of(segments[1], &TorqueSegment::knee);
  EXPECT_EQ(knee.samples, 7);
  EXPECT_NEAR(knee.mean, 30.0 / 7.0, 1e-12);
  EXPECT_NEAR(knee.deviation, std::sqrt(158.0 / 7.0 - 900.0 / 49.0), 1e-12);
  EXPECT_EQ(knee.quantile, (std::array<double, 3>{6.0, 6.0, 6.0}));
  EXPECT_EQ(knee.largest, 6.0);
  EXPECT_NEAR(distribution_of(segments[1], &TorqueSegment::wheel).mean, 0.6 / 7.0, 1e-12);
  const TorqueDistribution air = distribution_of(segments[0], &TorqueSegment::knee);
  EXPECT_EQ(air.samples, 1);
  EXPECT_EQ(air.mean, 0.5);
  EXPECT_EQ(air.deviation, 0.0);
}

TEST(TorqueMoments, LeaveOutTheBeginningAndStepsWithoutARecord) {
  RunSignals run = four_steps();
  run.signals[3].time = std::nan("");
  TorqueSegments segments;
  add_torques(run, 0.001, segments);
  EXPECT_EQ(distribution_of(segments[1], &TorqueSegment::knee).samples, 3);
  EXPECT_NEAR(distribution_of(segments[1], &TorqueSegment::knee).mean, 5.0, 1e-12);
}

TEST(TorqueMoments, OfNothingAreNotDefined) {
  const TorqueDistribution nothing = distribution_of({}, &TorqueSegment::knee);
  EXPECT_EQ(nothing.samples, 0);
  for (const double value : {nothing.mean, nothing.deviation, nothing.quantile[0], nothing.largest,
                             nothing.autocorrelation_time}) {
    EXPECT_TRUE(std::isnan(value));
  }
  EXPECT_TRUE(std::isnan(overlap({}, {TorqueSegment{0.001, {1.0}, {1.0}}})));
}

double draw(std::uint64_t run, std::uint64_t k) {
  return noise::standard_normal({.seed = 5, .run = run}, noise::NoiseChannel::left_hip_position, k);
}

TEST(TorqueQuantiles, OfAUniformSampleLieWhereTheyShould) {
  TorqueSegment segment;
  for (int i = 1000; i > 0; --i) segment.wheel.push_back(0.001 * i);
  const TorqueDistribution uniform = distribution_of({segment}, &TorqueSegment::wheel);
  EXPECT_NEAR(uniform.quantile[0], 0.5, 1e-9);
  EXPECT_NEAR(uniform.quantile[1], 0.9, 1e-9);
  EXPECT_NEAR(uniform.quantile[2], 0.99, 1e-9);
  EXPECT_NEAR(uniform.deviation, 1.0 / std::sqrt(12.0), 1e-4);
}

TEST(TorqueDensity, IsCountedInCellsAroundTheServosSteps) {
  // Of five steps two lie in the half cell around 0, and 0.07 is in its cell whatever its last bit.
  const TorqueSegment segment{0.001, {0.0, 0.004, 0.07, 0.0699, 0.03}, {}};
  const std::vector<double> density = density_of({segment}, &TorqueSegment::knee);
  EXPECT_THAT(density, ::testing::Pointwise(::testing::DoubleNear(1e-9),
                                            {80.0, 0.0, 0.0, 20.0, 0.0, 0.0, 0.0, 40.0}));
  EXPECT_TRUE(density_of({}, &TorqueSegment::knee).empty());
}

TEST(AutocorrelationTime, IsThatOfTheProcess) {
  // x(k+1) = r x(k) + noise has the autocorrelation r^lag: 1/e after −1/ln r steps.
  for (const double time : {0.0, 0.02, 0.3}) {
    for (const double period : {0.001, 0.005}) {
      const double r = time > 0.0 ? std::exp(-period / time) : 0.0;
      std::vector<TorqueSegment> segments(4, TorqueSegment{period});
      for (std::uint64_t run = 0; run < segments.size(); ++run) {
        double x = draw(run, 0);
        for (std::uint64_t k = 1; k < 100'000; ++k) {
          x = r * x + std::sqrt(1.0 - r * r) * draw(run, k);
          segments[run].knee.push_back(10.0 + x);
        }
      }
      const double found = distribution_of(segments, &TorqueSegment::knee).autocorrelation_time;
      EXPECT_NEAR(found, time, 0.15 * time + period) << time << " " << period;
    }
  }
}

TEST(AutocorrelationTime, DoesNotReachAcrossGaps) {
  // Steps within a segment are alike; those of neighbouring segments are opposite.
  std::vector<TorqueSegment> segments;
  for (int i = 0; i < 40; ++i) {
    segments.push_back({0.001, std::vector<double>(50, i % 2 == 0 ? 1.0 : 3.0), {}});
  }
  EXPECT_TRUE(std::isnan(distribution_of(segments, &TorqueSegment::knee).autocorrelation_time));
}

TEST(Overlap, OfTwoNormalDensitiesIsTheClosedForm) {
  // Equal deviations s, means d apart: erfc(d / (2 √2 s)). The wheel's torque is the same in both.
  constexpr double deviation = 0.1;
  for (const double apart : {0.0, 0.1, 0.3}) {
    std::array<TorqueSegment, 2> sample;
    for (std::uint64_t k = 0; k < 400'000; ++k) {
      for (std::uint64_t i = 0; i < 2; ++i) {
        sample[i].knee.push_back(1.0 + static_cast<double>(i) * apart + deviation * draw(i, k));
        sample[i].wheel.push_back(0.05);
      }
    }
    EXPECT_NEAR(overlap({sample[0]}, {sample[1]}),
                std::erfc(apart / (2.0 * std::numbers::sqrt2 * deviation)), 0.01)
        << apart;
  }
}

TEST(Overlap, UsesTheWheelToo) {
  const TorqueSegment a{0.001, {0.5, 0.5}, {0.1, 0.2}};
  const TorqueSegment b{0.001, {0.5, 0.5}, {0.2, 0.3}};
  EXPECT_DOUBLE_EQ(overlap({a}, {b}), 0.5);
  EXPECT_DOUBLE_EQ(overlap({a}, {a, a}), 1.0);
}

TEST(Overlap, PutsEveryStepOfTheServosIntoACellOfItsOwn) {
  TorqueSegment a, b;
  for (int i = 0; i < 150; ++i) {
    a.knee.push_back(0.01 * i);
    b.knee.push_back(0.01 * i + 0.004);
  }
  a.wheel = b.wheel = std::vector<double>(150, 0.0);
  EXPECT_NEAR(overlap({a}, {b}), 1.0, 1e-12);
}

TEST(Moments, AreTablesOfAnExperimentWithTheKey) {
  const ScratchFolder folder;
  folder.write("step.yaml", small_step_scene);
  const std::string scene = folder / "step.yaml";
  const auto read = [&](const std::string& more) {
    return experiment_from_yaml(
        YamlDocument::parse("name: step\nestimators: [robust]\n"
                            "fit: {scenarios: [" +
                                scene + "]}\n" + "test: {scenarios: [" + scene + "], runs: 2}\n" +
                                "video: {enabled: false}\n" + more,
                            "experiment.yaml"));
  };
  const ExperimentResult result =
      run_experiment(read("moments: true\n"), {folder / "run", "", nullptr});
  const auto table = [&](const char* name) {
    return from_csv(read_file(folder / "run/tables" / name));
  };
  const TextTable moments = table("moments.csv");
  EXPECT_THAT(moments.header, ::testing::ElementsAre("simulator", "joint", "contact", "mean_nm",
                                                     "sd_nm", "robot_mean_nm", "robot_sd_nm"));
  ASSERT_EQ(moments.rows.size(), 8U);
  EXPECT_EQ(moments.rows[0][0], "mujoco");
  EXPECT_EQ(moments.rows[0][5], "0.358000");
  const double contact = std::stod(moments.rows[0][3]);
  EXPECT_GT(contact, 3.0 * std::stod(moments.rows[2][3]));  // bent knees carry more than they hang
  const TextTable distributions = table("torque_distributions.csv");
  ASSERT_EQ(distributions.rows.size(), 8U);
  EXPECT_GE(std::stod(distributions.rows[0][7]), contact);
  // Each density is a density: it sums to 1 over its cells, the first of which is half as wide.
  const TextTable densities = table("torque_densities.csv");
  std::map<std::string, double> sums;
  for (const std::vector<std::string>& row : densities.rows) {
    const double width = cell(densities, row, "torque_nm") == "0.000000" ? 0.005 : 0.01;
    sums[row[0] + row[1] + row[2]] += width * std::stod(cell(densities, row, "density_per_nm"));
  }
  EXPECT_EQ(sums.size(), 8U);
  for (const auto& [which, sum] : sums) EXPECT_NEAR(sum, 1.0, 1e-4) << which;
  EXPECT_THAT(table("overlap.csv").rows[1],
              ::testing::ElementsAre("bullet", ::testing::_, "0.055000", "2", "0"));
  ASSERT_EQ(result.studies.size(), 1U);
  EXPECT_THAT(result.studies.front(), HasSubstr("knee, contact"));
  // They are the run's own files; without the key they are not written.
  const auto files = own_files(folder / "run");
  for (const char* name :
       {"moments.csv", "torque_distributions.csv", "torque_densities.csv", "overlap.csv"}) {
    EXPECT_THAT(files, ::testing::Contains(std::filesystem::path("tables") / name));
  }
}

}  // namespace
}  // namespace touchdown::experiments
