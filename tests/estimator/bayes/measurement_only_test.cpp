#include "estimator/bayes/measurement_only.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/estimator/synthetic.hpp"

namespace touchdown {
namespace {

using test::drops;
using test::labelled;

MeasurementModel fitted() {
  const BayesFilterConfig config = BayesFilterConfig::robust();
  const auto samples = labelled(drops(8000), config.measurement.torque);
  return fit_measurement_model(samples.contact, samples.no_contact, config.measurement.fit);
}

TEST(MeasurementOnly, IsTheNormalisedLikelihood) {
  const MeasurementModel model = fitted();
  const BayesFilterConfig config = BayesFilterConfig::robust();
  MeasurementOnly ablation(model);
  TorqueChannel right(config.measurement.torque, Side::right, 1000.0);
  for (const Signals& s : drops(2500, 1000.0, 5)) {
    const Likelihoods p = model(right.update(s.leg[1]));
    const double contact = p.contact + 1e-20;
    ASSERT_NEAR(ablation.update(s).wheel[1].p_contact, contact / (contact + p.no_contact), 1e-13);
  }
}

TEST(MeasurementOnly, DoesNotUseTheAccelerometer) {
  const MeasurementModel model = fitted();
  MeasurementOnly with(model);
  MeasurementOnly without(model);
  for (Signals s : drops(2500, 1000.0, 5)) {
    const double expected = with.update(s).wheel[0].p_contact;
    s.vertical_acceleration = std::nan("");
    ASSERT_EQ(without.update(s).wheel[0].p_contact, expected);
    ASSERT_EQ(without.belief().status, SignalStatus::good);
  }
}

TEST(MeasurementOnly, RelaxesWithoutTorques) {
  MeasurementOnly ablation(fitted());
  const auto stream = drops(700);
  for (const Signals& s : stream) {
    ablation.update(s);
  }
  ASSERT_GT(ablation.belief().wheel[0].p_contact, 0.9);
  Signals lost = stream.back();
  lost.leg[0].knee.torque = HUGE_VAL;
  for (int i = 1; i < 2000; ++i) {
    lost.time += 0.001;
    EXPECT_EQ(ablation.update(lost).status, SignalStatus::invalid);
  }
  EXPECT_NEAR(ablation.belief().wheel[0].p_contact, 0.5, 1e-6);
  EXPECT_GT(ablation.belief().wheel[1].p_contact, 0.9);
}

TEST(MeasurementOnly, IsUndecidedWhereBothLikelihoodsVanish) {
  EXPECT_EQ(measurement_probability({0.0, 0.0}), 0.5);
  EXPECT_EQ(measurement_probability({1e-300, 0.0}), 1.0);
  EXPECT_DOUBLE_EQ(measurement_probability({1.0, 3.0}), 0.25);
}

}  // namespace
}  // namespace touchdown
