#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace touchdown::scoring {

/// Calibration of the probability of contact: the Brier score and the reliability curve of
/// docs/reference/metrics.md, "Calibration". All members are sums over steps, so they add.
struct Calibration {
  static constexpr std::size_t bins = 10;

  /// Steps with a probability in [b/10, (b+1)/10); the last bin is closed.
  struct Bin {
    std::int64_t points = 0;
    std::int64_t contact = 0;
    double probability_sum = 0.0;

    double mean_probability() const { return probability_sum / static_cast<double>(points); }
    double contact_frequency() const {
      return static_cast<double>(contact) / static_cast<double>(points);
    }
  };

  std::array<Bin, bins> bin;
  double squared_error = 0.0;
  std::int64_t points = 0;

  void add(bool truth, double p_contact) {
    const double error = p_contact - (truth ? 1.0 : 0.0);
    squared_error += error * error;
    points += 1;
    const auto b = std::min(static_cast<std::size_t>(std::max(p_contact, 0.0) * bins), bins - 1);
    bin[b].points += 1;
    bin[b].contact += truth ? 1 : 0;
    bin[b].probability_sum += p_contact;
  }

  Calibration& operator+=(const Calibration& other) {
    for (std::size_t b = 0; b < bins; ++b) {
      bin[b].points += other.bin[b].points;
      bin[b].contact += other.bin[b].contact;
      bin[b].probability_sum += other.bin[b].probability_sum;
    }
    squared_error += other.squared_error;
    points += other.points;
    return *this;
  }

  /// Expected calibration error: mean |mean probability − share of contact| over the bins, weighted
  /// by their points; NaN without points.
  double expected_error() const {
    double sum = 0.0;
    for (const Bin& b : bin) {
      if (b.points > 0) sum += std::abs(b.probability_sum - static_cast<double>(b.contact));
    }
    return sum / static_cast<double>(points);
  }

  /// Mean squared error of the probability; NaN without points.
  double brier() const { return squared_error / static_cast<double>(points); }
};

}  // namespace touchdown::scoring
