#include "estimator/bayes/measurement_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/bayes/filter.hpp"
#include "estimator/numerics/kernel_density.hpp"
#include "tests/estimator/named_config.hpp"
#include "tests/estimator/synthetic.hpp"

namespace touchdown {
namespace {

TEST(MeasurementFit, IsTheKernelDensityOfTheSamplesOfEachClass) {
  for (const char* name : {"robust", "reference", "paper"}) {
    const BayesFilterConfig config = test::named(name);
    MeasurementFitConfig fit = config.measurement.fit;
    fit.knee_count = 61;
    fit.wheel_count = 47;
    const auto samples = test::labelled(test::drops(3001), config.measurement.torque);
    const MeasurementFit fitted = fit_measurement(samples.contact, samples.no_contact, fit);
    const LikelihoodGrids grids = fitted.model.grids();
    for (const bool contact : {false, true}) {
      std::vector<double> knee, wheel;
      for (const TorqueSample& sample : contact ? samples.contact : samples.no_contact) {
        knee.push_back(sample.knee);
        wheel.push_back(sample.wheel);
      }
      const TorqueBandwidth bandwidth = fitted.bandwidth[contact ? 1 : 0];
      if (!fit.bandwidth) {
        EXPECT_EQ(bandwidth.knee, scott_bandwidth(knee, 2, fit.bandwidth_floor.knee)) << name;
        EXPECT_EQ(bandwidth.wheel, scott_bandwidth(wheel, 2, fit.bandwidth_floor.wheel)) << name;
      }
      const std::vector<double> expected =
          kernel_density(wheel, knee, bandwidth.wheel, bandwidth.knee, grids.wheel, grids.knee);
      const std::vector<double>& found = contact ? grids.contact : grids.no_contact;
      ASSERT_EQ(found.size(), expected.size());
      const double largest = *std::max_element(expected.begin(), expected.end());
      for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_NEAR(found[i], expected[i], 1e-12 * largest) << name << " " << i;
      }
    }
  }
}

TEST(MeasurementFit, FindsTheBandwidthOfTorquesFarFromZero) {
  std::vector<TorqueSample> samples, near_zero;
  for (int i = 0; i < 1000; ++i) {
    samples.push_back({1e6 + 1e-3 * i, 0.001 * i});
    near_zero.push_back({1e-3 * i, 0.001 * i});
  }
  MeasurementFitConfig small;
  small.knee_count = small.wheel_count = 5;
  // A difference of sums of squares would be off by a tenth.
  EXPECT_NEAR(fit_measurement(samples, samples, small).bandwidth[1].knee,
              fit_measurement(near_zero, near_zero, small).bandwidth[1].knee, 1e-7);
}

TEST(MeasurementFit, RefusesWhatCannotBeFitted) {
  using Samples = std::vector<TorqueSample>;
  Samples good, equal(5, TorqueSample{1.0, 1.0});
  for (int i = 0; i < 5; ++i) good.push_back({0.1 * i, 0.2 * i});
  Samples nan = good, infinite = good;
  nan.push_back({std::numeric_limits<double>::quiet_NaN(), 0.0});
  infinite.push_back({0.0, std::numeric_limits<double>::infinity()});
  for (const Samples& bad : {Samples{}, Samples{{0.1, 0.2}}, nan, infinite, equal}) {
    EXPECT_THROW(fit_measurement(good, bad, {}), InputError);
    EXPECT_THROW(fit_measurement(bad, good, {}), InputError);
  }
  MeasurementFitConfig floor;
  floor.bandwidth_floor = {0.1, 0.1};
  EXPECT_NO_THROW(fit_measurement(good, equal, floor));
  floor.bandwidth_floor = {};
  floor.bandwidth = TorqueBandwidth{0.1, 0.1};
  EXPECT_THROW(fit_measurement(good, nan, floor), InputError);
}

}  // namespace
}  // namespace touchdown
