#include "estimator/bayes/measurement_model.hpp"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/bayes/measurement_fit.hpp"
#include "estimator/numerics/kernel_density.hpp"
#include "tests/complaint.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

using test::Normal;

std::vector<TorqueSample> cloud(std::size_t count, TorqueSample centre, double deviation,
                                std::uint32_t seed) {
  Normal normal(seed);
  std::vector<TorqueSample> samples(count);
  for (TorqueSample& sample : samples) {
    sample = {centre.knee + deviation * normal(), centre.wheel + deviation * normal()};
  }
  return samples;
}

/// Bilinear functions, which bilinear interpolation must reproduce exactly.
double contact_plane(double knee, double wheel) { return 10.0 + knee + 2.0 * wheel; }
double no_contact_plane(double knee, double wheel) { return 7.0 + 3.0 * knee + knee * wheel; }

LikelihoodGrids planes() {
  LikelihoodGrids grids{Axis{-1.0, 2.0, 7}, Axis{-0.5, 1.0, 4}, {}, {}};
  for (int i = 0; i < grids.wheel.count; ++i) {
    for (int j = 0; j < grids.knee.count; ++j) {
      grids.contact.push_back(contact_plane(grids.knee[j], grids.wheel[i]));
      grids.no_contact.push_back(no_contact_plane(grids.knee[j], grids.wheel[i]));
    }
  }
  return grids;
}

TEST(MeasurementModel, InterpolatesBothLikelihoodsBilinearly) {
  const MeasurementModel model(planes());
  for (const double knee : {-1.0, -0.3, 0.0, 1.234, 2.0}) {
    for (const double wheel : {-0.5, 0.01, 0.7, 1.0}) {
      const Likelihoods p = model({knee, wheel});
      EXPECT_NEAR(p.contact, contact_plane(knee, wheel), 1e-13);
      EXPECT_NEAR(p.no_contact, no_contact_plane(knee, wheel), 1e-13);
    }
  }
}

TEST(MeasurementModel, TakesTheNearestEdgeOutsideTheGrid) {
  const MeasurementModel model(planes());
  EXPECT_NEAR(model({-5.0, 0.2}).contact, contact_plane(-1.0, 0.2), 1e-13);
  EXPECT_NEAR(model({1e9, 0.2}).no_contact, no_contact_plane(2.0, 0.2), 1e-13);
  EXPECT_NEAR(model({1.0, -HUGE_VAL}).contact, contact_plane(1.0, -0.5), 1e-13);
  EXPECT_NEAR(model({HUGE_VAL, HUGE_VAL}).contact, contact_plane(2.0, 1.0), 1e-13);
  EXPECT_TRUE(std::isfinite(model({std::nan(""), std::nan("")}).contact));
}

TEST(MeasurementModel, ReturnsItsGrids) {
  const LikelihoodGrids grids = planes();
  const LikelihoodGrids back = MeasurementModel(grids).grids();
  EXPECT_EQ(back.knee, grids.knee);
  EXPECT_EQ(back.wheel, grids.wheel);
  EXPECT_EQ(back.contact, grids.contact);
  EXPECT_EQ(back.no_contact, grids.no_contact);
}

TEST(MeasurementModel, RefusesGridsThatAreNotLikelihoods) {
  LikelihoodGrids grids = planes();
  grids.contact.pop_back();
  EXPECT_THROW(MeasurementModel{grids}, InputError);
  grids = planes();
  grids.no_contact[3] = std::nan("");
  EXPECT_THROW(MeasurementModel{grids}, InputError);
  grids.no_contact[3] = -1.0;
  EXPECT_THROW(MeasurementModel{grids}, InputError);
  grids = planes();
  grids.knee.count = 1;
  EXPECT_THROW(MeasurementModel{grids}, InputError);
}

TEST(MeasurementModel, IsFittedWithScottsRuleAboveItsFloor) {
  const auto contact = cloud(500, {1.3, 0.2}, 0.1, 1);
  const auto no_contact = cloud(500, {0.0, 0.0}, 0.001, 2);
  MeasurementFitConfig config;
  config.bandwidth_floor = {0.1, 0.05};
  config.knee_range = {-1.0, 3.0};
  config.wheel_range = {-1.0, 1.0};
  config.knee_count = 31;
  config.wheel_count = 17;
  const LikelihoodGrids grids = fit_measurement_model(contact, no_contact, config).grids();
  EXPECT_EQ(grids.knee, (Axis{-1.0, 3.0, 31}));
  EXPECT_EQ(grids.wheel, (Axis{-1.0, 1.0, 17}));
  std::vector<double> knee;
  std::vector<double> wheel;
  for (const TorqueSample& sample : no_contact) {
    knee.push_back(sample.knee);
    wheel.push_back(sample.wheel);
  }
  EXPECT_EQ(grids.no_contact, kernel_density(wheel, knee, 0.05, 0.1, grids.wheel, grids.knee));
}

TEST(MeasurementModel, CoversItsSamplesByDefault) {
  std::vector<TorqueSample> contact = cloud(50, {1.3, -0.2}, 0.1, 1);
  std::vector<TorqueSample> no_contact = cloud(50, {0.4, 0.0}, 0.01, 2);
  MeasurementFitConfig config;
  config.bandwidth = TorqueBandwidth{0.1, 0.05};
  const MeasurementModel model = fit_measurement_model(contact, no_contact, config);
  EXPECT_EQ(model.knee_axis().lower, 0.0) << "no knee sample was negative";
  EXPECT_LT(model.wheel_axis().lower, -0.2);
  for (const auto& sample : contact) {
    EXPECT_LE(sample.knee + 0.4, model.knee_axis().upper + 1e-12);
    EXPECT_GE(sample.wheel - 0.2, model.wheel_axis().lower - 1e-12);
  }
}

TEST(MeasurementModel, NamesTheClassThatCannotBeFitted) {
  const auto good = cloud(50, {1.3, -0.2}, 0.1, 1);
  const std::vector<TorqueSample> none;
  const std::vector<TorqueSample> one{{1.0, 1.0}};
  std::vector<TorqueSample> bad = good;
  bad[7].wheel = std::nan("");
  const MeasurementFitConfig config;
  EXPECT_THROW(fit_measurement_model(good, one, config), InputError);
  EXPECT_THROW(fit_measurement_model(bad, good, config), InputError);
  EXPECT_THAT(complaint_of([&] { fit_measurement_model(good, none, config); }),
              ::testing::HasSubstr("no-contact"));
}

TEST(TorqueChannel, MirrorsTheRightLeg) {
  LegSignals leg;
  leg.knee.torque = -1.5;
  leg.wheel.torque = 0.25;
  TorqueChannel left({TorqueSign::mirrored, 0.0}, Side::left, 1000.0);
  TorqueChannel right({TorqueSign::mirrored, 0.0}, Side::right, 1000.0);
  TorqueChannel absolute({TorqueSign::absolute, 0.0}, Side::right, 1000.0);
  EXPECT_EQ(left.update(leg).knee, -1.5);
  EXPECT_EQ(left.update(leg).wheel, 0.25);
  EXPECT_EQ(right.update(leg).knee, 1.5);
  EXPECT_EQ(right.update(leg).wheel, -0.25);
  EXPECT_EQ(absolute.update(leg).knee, 1.5);
  EXPECT_EQ(absolute.update(leg).wheel, 0.25);
}

TEST(TorqueChannel, FiltersBeforeItDropsTheSign) {
  TorqueChannel channel({TorqueSign::absolute, 0.025}, Side::left, 1000.0);
  LegSignals leg;
  TorqueSample m;
  for (int i = 0; i < 1001; ++i) {
    leg.knee.torque = i % 2 == 0 ? 1.0 : -1.0;
    m = channel.update(leg);
  }
  EXPECT_LT(m.knee, 0.05);
  leg.knee.torque = 2.0;
  for (int i = 0; i < 25; ++i) {
    m = channel.update(leg);
  }
  EXPECT_NEAR(m.knee, 2.0 * (1.0 - std::exp(-1.0)), 0.05);
}

}  // namespace
}  // namespace touchdown
