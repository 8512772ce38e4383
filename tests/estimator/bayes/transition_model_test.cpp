#include "estimator/bayes/transition_model.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "estimator/bayes/filter.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

using test::Normal;

/// Power and median of a whole window, by their definitions.
struct PlainSpectrum {
  double mean_square = 0.0;
  double median = 0.0;  // Hz
};

PlainSpectrum plain_spectrum(const std::vector<double>& window, double rate, SpectrumKind kind,
                             bool nyquist) {
  const auto n = static_cast<int>(window.size());
  PlainSpectrum result;
  for (const double a : window) {
    result.mean_square += a * a / n;
  }
  std::vector<double> cumulative;
  const int last = nyquist || n % 2 == 1 ? n / 2 : n / 2 - 1;
  for (int k = 0; k <= last; ++k) {
    std::complex<double> x;
    for (int i = 0; i < n; ++i) {
      x += window[static_cast<std::size_t>(i)] *
           std::polar(1.0, -2.0 * std::numbers::pi * k * i / n);
    }
    const double value = kind == SpectrumKind::power ? std::norm(x) : std::abs(x);
    cumulative.push_back(value + (cumulative.empty() ? 0.0 : cumulative.back()));
  }
  const double half = cumulative.back() / 2.0;
  for (std::size_t k = 1; k < cumulative.size(); ++k) {
    if (cumulative[k] >= half && cumulative[k - 1] < half) {
      const double fraction = (half - cumulative[k - 1]) / (cumulative[k] - cumulative[k - 1]);
      result.median = (static_cast<double>(k - 1) + fraction) * rate / n;
    }
  }
  return result;
}

struct SpectrumCase {
  int window;
  SpectrumKind kind;
  bool nyquist;
};

class TransitionSpectrum : public testing::TestWithParam<SpectrumCase> {};

TEST_P(TransitionSpectrum, HasThePowerAndMedianOfTheWindow) {
  const double rate = 400.0;
  TransitionConfig config;
  config.window = GetParam().window;
  config.median_of = GetParam().kind;
  config.nyquist = GetParam().nyquist;
  TransitionModel model(config, rate);
  std::vector<double> window(static_cast<std::size_t>(config.window), 0.0);
  Normal normal(3);
  for (int t = 0; t < 2000; ++t) {
    const double a = normal() + 3.0 * std::sin(0.3 * t) + (t % 500 == 100 ? 100.0 : 0.0) +
                     (t > 1500 ? 5.0 : 0.0);
    window.erase(window.begin());
    window.push_back(a);
    const Transition& transition = model.update(a);
    if (t % 37 == 0) {
      const PlainSpectrum expected = plain_spectrum(window, rate, config.median_of, config.nyquist);
      ASSERT_NEAR(transition.power, expected.mean_square, 1e-10 * (1.0 + expected.mean_square));
      ASSERT_NEAR(transition.median_frequency, expected.median, 1e-9) << t;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AnySpectrum, TransitionSpectrum,
                         testing::Values(SpectrumCase{128, SpectrumKind::power, true},
                                         SpectrumCase{128, SpectrumKind::magnitude, false},
                                         SpectrumCase{128, SpectrumKind::power, false},
                                         SpectrumCase{101, SpectrumKind::magnitude, true},
                                         SpectrumCase{64, SpectrumKind::magnitude, true},
                                         SpectrumCase{130, SpectrumKind::magnitude, true},
                                         SpectrumCase{200, SpectrumKind::power, true},
                                         SpectrumCase{3, SpectrumKind::magnitude, true},
                                         SpectrumCase{2, SpectrumKind::power, true}));

TEST(TransitionModel, FindsAMedianInTheLastBin) {
  for (const SpectrumKind kind : {SpectrumKind::power, SpectrumKind::magnitude}) {
    TransitionConfig config;
    config.median_of = kind;
    TransitionModel model(config, 1000.0);
    for (int t = 0; t < 256; ++t) {
      model.update(t % 2 == 0 ? 1.0 : -1.0);
    }
    EXPECT_NEAR(model.transition().median_frequency, 63.5 * 1000.0 / 128.0, 1e-9);
    EXPECT_NEAR(model.transition().power, 1.0, 1e-12);
  }
}

TEST(TransitionModel, FindsTheFrequencyOfASine) {
  TransitionModel model(TransitionConfig{}, 1000.0);
  for (int t = 0; t < 512; ++t) {
    model.update(2.0 * std::sin(2.0 * std::numbers::pi * 125.0 * t / 1000.0));
  }
  // All energy is in bin 16, so the cumulative sum climbs to its half between bins 15 and 16.
  EXPECT_NEAR(model.transition().median_frequency, 15.5 * 1000.0 / 128.0, 1e-6);
  EXPECT_NEAR(model.transition().power, 2.0, 1e-9);
}

TEST(TransitionModel, HasNoFrequencyWithoutEnergy) {
  TransitionModel model(TransitionConfig{}, 1000.0);
  for (int t = 0; t < 10; ++t) {
    EXPECT_EQ(model.update(0.0).median_frequency, 0.0);
  }
  model.update(300.0);
  for (int t = 0; t < 200; ++t) {
    model.update(0.0);
  }
  EXPECT_EQ(model.transition().median_frequency, 0.0) << "only rounding errors are left";
  for (int t = 0; t < 200; ++t) {
    model.update(-9.81);
  }
  EXPECT_EQ(model.transition().median_frequency, 0.0) << "a constant has frequency 0";
  EXPECT_NEAR(model.transition().power, 9.81 * 9.81, 1e-9);
}

TEST(TransitionModel, MeasuresPowerAsMeanOrAsEnergy) {
  TransitionConfig config;
  config.power = PowerMeasure::energy;
  TransitionModel energy(config, 1000.0);
  for (int t = 0; t < 300; ++t) {
    energy.update(0.5);
  }
  EXPECT_NEAR(energy.transition().power, 128.0 * 0.25, 1e-9);
}

TEST(TransitionModel, SwitchesWithProbabilityOneHalfAtARootMeanSquareOfEight) {
  // With the mean square, 2.8 m/s² have that probability.
  test::Normal normal(4);
  for (const double deviation : {std::sqrt(8.0), 8.0}) {
    TransitionModel square(BayesFilterConfig::paper().transition, 1000.0);
    TransitionModel root(BayesFilterConfig::paper_rms().transition, 1000.0);
    std::vector<double> window;
    for (int t = 0; t < 128; ++t) window.push_back(deviation * normal());
    double squares = 0.0;
    for (const double a : window) squares += a * a / 128.0;
    for (double& a : window) a *= deviation / std::sqrt(squares);
    for (const double a : window) {
      square.update(a);
      root.update(a);
    }
    EXPECT_NEAR(root.transition().power, deviation, 1e-9);
    EXPECT_NEAR(square.transition().power, deviation * deviation, 1e-9);
    EXPECT_NEAR((deviation == 8.0 ? root : square).transition().p_switch, 0.5, 1e-9);
    if (deviation == 8.0) {
      EXPECT_GT(square.transition().p_switch, 0.999);
    } else {
      EXPECT_LT(root.transition().p_switch, 0.01);
    }
  }
  TransitionModel empty(BayesFilterConfig::paper_rms().transition, 1000.0);
  empty.update(300.0);
  for (int t = 0; t < 300; ++t) {
    EXPECT_GE(empty.update(0.0).power, 0.0);  // despite rounding errors
  }
}

TEST(TransitionModel, RowsSumToOneOrAsPublished) {
  for (const bool row_stochastic : {true, false}) {
    TransitionConfig config;
    config.row_stochastic = row_stochastic;
    TransitionModel model(config, 1000.0);
    Normal normal(4);
    for (int t = 0; t < 300; ++t) {
      const Transition& p = model.update(2.5 * normal());
      const double contact_row = p.contact_to_contact + p.contact_to_air;
      const double air_row = p.air_to_air + p.air_to_contact;
      EXPECT_NEAR(contact_row, row_stochastic ? 1.0 : 1.0 - p.p_switch * p.p_landing, 1e-14);
      EXPECT_NEAR(air_row, row_stochastic ? 1.0 : 1.0 - p.p_switch * (1.0 - p.p_landing), 1e-14);
    }
  }
}

TEST(TransitionModel, LowPassesTheMedianLikeTheAuthorsCode) {
  const TransitionConfig config = BayesFilterConfig::reference().transition;
  TransitionModel model(config, 1000.0);
  Normal normal(8);
  double remembered = 0.0;
  for (int t = 0; t < 500; ++t) {
    const Transition& p = model.update(10.0 * normal());
    for (int twice = 0; twice < 2; ++twice) {
      remembered += 0.001 / 0.1 * (p.median_frequency * p.p_switch - remembered);
    }
    ASSERT_NEAR(p.filtered_median_frequency, remembered, 1e-12 * (1.0 + remembered));
    const auto clamped = [](double x) { return std::max(1e-10, std::min(1.0 - 1e-10, x)); };
    ASSERT_NEAR(p.p_landing, clamped(1.0 / (1.0 + std::exp(-(remembered - 8.0) / 3.0))), 1e-12);
    ASSERT_NEAR(p.p_switch, clamped(1.0 / (1.0 + std::exp(-(p.power - 50.0) / 5.0))), 1e-12);
  }
}

TEST(TransitionModel, KeepsProbabilitiesWithinItsMargin) {
  TransitionConfig config;
  config.margin = 1e-3;
  TransitionModel model(config, 1000.0);
  EXPECT_EQ(model.update(1e4).p_switch, 1.0 - 1e-3);
}

TEST(TransitionModel, RefusesInvalidValues) {
  const TransitionConfig good;
  EXPECT_THROW(TransitionModel(good, 0.0), InputError);
  EXPECT_THROW(TransitionModel(good, std::nan("")), InputError);
  TransitionConfig bad = good;
  bad.window = 1;
  EXPECT_THROW(TransitionModel(bad, 1000.0), InputError);
  bad = good;
  bad.switch_sigmoid.slope = 0.0;
  EXPECT_THROW(TransitionModel(bad, 1000.0), InputError);
  bad = good;
  bad.margin = 0.5;
  EXPECT_THROW(TransitionModel(bad, 1000.0), InputError);
  bad = good;
  bad.median_memory = -1.0;
  EXPECT_THROW(TransitionModel(bad, 1000.0), InputError);
}

}  // namespace
}  // namespace touchdown
