#include "scoring/bootstrap.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "core/random.hpp"

namespace touchdown::scoring {
namespace {

/// Sums of values and how many there are: the mean is their ratio.
struct Mean {
  double sum = 0.0;
  double count = 0.0;

  Mean& operator+=(const Mean& other) {
    sum += other.sum;
    count += other.count;
    return *this;
  }
};

double mean(const Mean& m) { return m.sum / m.count; }

double exponential(std::uint64_t seed, std::uint64_t stream, std::uint64_t i) {
  return -std::log(uniform01(seed, stream, i));
}

TEST(Bootstrap, EndsWhenItIsAskedToStop) {
  struct Enough {};
  int calls = 0;
  BootstrapConfig config{.resamples = 100'000};
  config.before_resamples = [&] {
    if (++calls == 3) throw Enough();
  };
  const std::vector<Mean> samples = {{1.0, 1.0}, {2.0, 1.0}};
  EXPECT_THROW(bootstrap<Mean>(samples, {mean}, config), Enough);
  EXPECT_EQ(calls, 3);
  calls = 0;
  EXPECT_THROW(bootstrap_differences<Mean>(samples, samples, {mean}, config), Enough);
  EXPECT_EQ(calls, 3);
}

TEST(Bootstrap, CoversTheMeanOfAnExponentialAtItsLevel) {
  int covered = 0;
  constexpr int studies = 500;
  for (std::uint64_t study = 0; study < studies; ++study) {
    std::vector<Mean> samples(80);
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = {exponential(1, study, i), 1.0};
    const Interval interval =
        bootstrap<Mean>(samples, {mean}, {.resamples = 400, .seed = study}).front();
    covered += interval.low <= 1.0 && 1.0 <= interval.high ? 1 : 0;
  }
  // Percentile intervals of skewed means cover a little less than their level: 0.95 ± 3 standard
  // errors of 500 trials, and 1.5 % for the skew.
  EXPECT_GT(covered, 0.906 * studies);
  EXPECT_LT(covered, 0.98 * studies);
}

TEST(Bootstrap, CoversARatioOfSumsOfUnequalWeights) {
  // Each sample: Poisson-like weight w in 1..20 and w·q successes with q = 0.8 ± 0.2 per sample.
  int covered = 0;
  constexpr int studies = 500;
  for (std::uint64_t study = 0; study < studies; ++study) {
    std::vector<Mean> samples(60);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double weight = std::floor(1.0 + 20.0 * uniform01(2, study, i));
      samples[i] = {weight * (0.6 + 0.4 * uniform01(3, study, i)), weight};
    }
    const Interval interval =
        bootstrap<Mean>(samples, {mean}, {.resamples = 400, .seed = study}).front();
    covered += interval.low <= 0.8 && 0.8 <= interval.high ? 1 : 0;
  }
  EXPECT_GT(covered, 0.906 * studies);
  EXPECT_LT(covered, 0.98 * studies);
}

TEST(Bootstrap, OfADifferenceIsNarrowerWhenItsSamplesArePaired) {
  std::vector<Paired<Mean>> paired(50);
  std::vector<Mean> first(50);
  std::vector<Mean> second(50);
  for (std::size_t i = 0; i < paired.size(); ++i) {
    const double shared = exponential(5, 0, i);
    first[i] = {shared + 0.1, 1.0};
    second[i] = {shared + 0.02 * uniform01(5, 1, i), 1.0};
    paired[i] = {first[i], second[i]};
  }
  const auto difference = [](const Paired<Mean>& p) { return mean(p.first) - mean(p.second); };
  const Interval interval = bootstrap<Paired<Mean>>(paired, {difference}, {}).front();
  EXPECT_NEAR(interval.estimate, 0.09, 0.005);
  EXPECT_LT(interval.high - interval.low, 0.01);
  const Interval alone = bootstrap<Mean>(first, {mean}, {}).front();
  EXPECT_GT(alone.high - alone.low, 0.2);
}

TEST(Bootstrap, DependsOnItsSeedOnly) {
  std::vector<Mean> samples(20);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = {exponential(9, 0, i), 1.0};
  const Interval once = bootstrap<Mean>(samples, {mean}, {.seed = 4}).front();
  const Interval again = bootstrap<Mean>(samples, {mean}, {.seed = 4}).front();
  const Interval other = bootstrap<Mean>(samples, {mean}, {.seed = 5}).front();
  EXPECT_EQ(once.low, again.low);
  EXPECT_EQ(once.high, again.high);
  EXPECT_NE(once.low, other.low);
  EXPECT_EQ(once.estimate, other.estimate);
}

/// P(from ≤ k ≤ to) of a binomial distribution, summed term by term.
double binomial_tail(int n, double p, int from, int to) {
  double sum = 0.0;
  for (int k = from; k <= to; ++k) {
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) +
                    k * std::log(p) + (n - k) * std::log1p(-p));
  }
  return sum;
}

TEST(ExactEnd, HasTheTailProbabilityOfTheLevel) {
  for (const int n : {1, 3, 70, 400}) {
    const Interval all = with_exact_end({1.0, 1.0, 1.0}, n, 0.95);
    EXPECT_NEAR(binomial_tail(n, all.low, n, n), 0.025, 1e-9) << n;
    EXPECT_EQ(all.high, 1.0);
    const Interval none = with_exact_end({0.0, 0.0, 0.0}, n, 0.9);
    EXPECT_NEAR(binomial_tail(n, none.high, 0, 0), 0.05, 1e-9) << n;
    EXPECT_EQ(none.low, 0.0);
  }
  EXPECT_NEAR(with_exact_end({1.0, 1.0, 1.0}, 70, 0.95).low, 0.949, 5e-4);
  const Interval some = with_exact_end({0.9, 0.8, 1.0}, 10, 0.95);  // others are kept
  EXPECT_EQ(some.low, 0.8);
  EXPECT_EQ(some.high, 1.0);
  EXPECT_EQ(with_exact_end({1.0, 1.0, 1.0}, 0, 0.95).low, 1.0);
}

TEST(Bootstrap, LeavesOutResamplesWithZeroDenominator) {
  std::vector<Mean> samples(4);
  samples[0] = {0.5, 1.0};
  const Interval interval = bootstrap<Mean>(samples, {mean}, {}).front();
  EXPECT_EQ(interval.low, 0.5);
  EXPECT_EQ(interval.high, 0.5);
  const Interval none = bootstrap<Mean>(std::vector<Mean>(3), {mean}, {}).front();
  EXPECT_TRUE(std::isnan(none.estimate));
  EXPECT_TRUE(std::isnan(none.low));
  const Interval empty = bootstrap<Mean>(std::vector<Mean>{}, {mean}, {}).front();
  EXPECT_TRUE(std::isnan(empty.high));
  const Interval equal = bootstrap<Mean>(std::vector<Mean>(8, {0.5, 1.0}), {mean}, {}).front();
  EXPECT_EQ(equal.low, 0.5);
  EXPECT_EQ(equal.high, 0.5);
}

TEST(Bootstrap, OfOneSampleHasNoInterval) {
  const std::vector<Mean> one = {{3.0, 4.0}};
  const Interval interval = bootstrap<Mean>(one, {mean}, {}).front();
  EXPECT_EQ(interval.estimate, 0.75);
  EXPECT_TRUE(std::isnan(interval.low) && std::isnan(interval.high));
  const Interval perfect = with_exact_end({1.0, interval.low, interval.high}, 10, 0.95);
  EXPECT_EQ(perfect.estimate, 1.0);
  EXPECT_TRUE(std::isnan(perfect.low) && std::isnan(perfect.high));
  const Interval difference = bootstrap_differences<Mean>(one, one, {mean}, {}).front();
  EXPECT_EQ(difference.estimate, 0.0);
  EXPECT_TRUE(std::isnan(difference.low));
}

TEST(ExactShare, MatchesTheTablesOfClopperAndPearson) {
  const Interval half = exact_share(5, 10, 0.95);
  EXPECT_EQ(half.estimate, 0.5);
  EXPECT_NEAR(half.low, 0.1871, 5e-5);
  EXPECT_NEAR(half.high, 0.8129, 5e-5);
  const Interval few = exact_share(3, 40, 0.95);
  EXPECT_NEAR(few.low, 0.0157, 5e-5);
  EXPECT_NEAR(few.high, 0.2039, 5e-5);
  const Interval all = exact_share(8, 8, 0.95);  // one end in closed form
  EXPECT_NEAR(all.low, std::pow(0.025, 1.0 / 8.0), 1e-12);
  EXPECT_EQ(all.high, 1.0);
  const Interval none = exact_share(0, 8, 0.95);
  EXPECT_EQ(none.low, 0.0);
  EXPECT_NEAR(none.high, 1.0 - std::pow(0.025, 1.0 / 8.0), 1e-12);
  EXPECT_TRUE(std::isnan(exact_share(0, 0, 0.95).low));
}

TEST(ExactShare, OfManyTrialsMatchesTheNormalDistribution) {
  const Interval many = exact_share(30'000, 100'000, 0.95);
  const double half_width = 1.96 * std::sqrt(0.3 * 0.7 / 1e5);
  EXPECT_NEAR(many.low, 0.3 - half_width, 0.02 * half_width);
  EXPECT_NEAR(many.high, 0.3 + half_width, 0.02 * half_width);
}

}  // namespace
}  // namespace touchdown::scoring
