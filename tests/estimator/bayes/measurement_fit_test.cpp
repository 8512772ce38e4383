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

MeasurementModel fitted_one_by_one(const test::LabelledSamples& samples,
                                   const MeasurementFitConfig& config) {
  MeasurementFit fit(config);
  const auto for_each_sample = [&](auto use) {
    for (const TorqueSample& sample : samples.no_contact) use(false, sample);
    for (const TorqueSample& sample : samples.contact) use(true, sample);
  };
  for_each_sample([&](bool contact, const TorqueSample& sample) { fit.survey(contact, sample); });
  fit.prepare();
  for_each_sample([&](bool contact, const TorqueSample& sample) { fit.add(contact, sample); });
  return fit.model();
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  const double largest = *std::max_element(a.begin(), a.end());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1e-12 * largest) << i;
}

TEST(MeasurementFit, IsTheFitOfAllSamplesAtOnce) {
  for (const char* name : {"robust", "reference", "paper"}) {
    const BayesFilterConfig config = test::named(name);
    MeasurementFitConfig fit = config.measurement.fit;
    fit.knee_count = 61;
    fit.wheel_count = 47;
    const auto samples = test::labelled(test::drops(3001), config.measurement.torque);
    const LikelihoodGrids whole_run =
        fit_measurement_model(samples.contact, samples.no_contact, fit).grids();
    const LikelihoodGrids one_by_one = fitted_one_by_one(samples, fit).grids();
    EXPECT_NEAR(whole_run.knee.upper, one_by_one.knee.upper, 1e-12);
    EXPECT_NEAR(whole_run.wheel.lower, one_by_one.wheel.lower, 1e-12);
    expect_near(whole_run.contact, one_by_one.contact);
    expect_near(whole_run.no_contact, one_by_one.no_contact);
  }
}

TEST(MeasurementFit, FindsTheBandwidthOfTorquesFarFromZero) {
  MeasurementFit fit({});
  std::vector<double> knee;
  for (int i = 0; i < 1000; ++i) {
    const double offset = 1e6 + 1e-3 * i;
    knee.push_back(offset);
    fit.survey(true, {offset, 0.001 * i});
    fit.survey(false, {offset, 0.001 * i});
  }
  fit.prepare();
  // A difference of sums of squares would be off by a tenth.
  EXPECT_NEAR(fit.bandwidth(true).knee, scott_bandwidth(knee, 2), 1e-7);
  EXPECT_EQ(fit.count(true), 1000U);
}

TEST(MeasurementFit, RefusesWhatCannotBeFitted) {
  MeasurementFit fit({});
  EXPECT_THROW(fit.survey(true, {std::numeric_limits<double>::quiet_NaN(), 0.0}), InputError);
  EXPECT_THROW(fit.survey(true, {0.0, std::numeric_limits<double>::infinity()}), InputError);
  EXPECT_THROW(fit.prepare(), InputError);  // nothing at all
  for (int i = 0; i < 5; ++i) fit.survey(true, {0.1 * i, 0.2 * i});
  EXPECT_THROW(fit.prepare(), InputError);  // one class only
  for (int i = 0; i < 5; ++i) fit.survey(false, {1.0, 1.0});
  EXPECT_THROW(fit.prepare(), InputError);  // all equal, no floor
}

}  // namespace
}  // namespace touchdown
