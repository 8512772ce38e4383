#include "experiments/studies/moments/torques.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "scoring/histogram.hpp"

namespace touchdown::experiments {

namespace {

constexpr double not_defined = std::numeric_limits<double>::quiet_NaN();

long cell_of(double torque) { return std::lround(torque / torque_cell); }

/// The share of all steps in each cell of the (knee, wheel) plane.
using SharesByCell = std::map<std::array<long, 2>, double>;

SharesByCell shares_by_cell(const std::vector<TorqueSegment>& segments) {
  SharesByCell shares;
  double steps = 0.0;
  for (const TorqueSegment& segment : segments) {
    for (std::size_t k = 0; k < segment.knee.size(); ++k, ++steps) {
      ++shares[{cell_of(segment.knee[k]), cell_of(segment.wheel[k])}];
    }
  }
  for (auto& [where, share] : shares) share /= steps;
  return shares;
}

/// Covariance of steps that are `lag` (s) apart within one segment; NaN without such steps.
double autocovariance(const std::vector<TorqueSegment>& segments, Joint joint, double mean,
                      double lag) {
  double sum = 0.0;
  double pairs = 0.0;
  for (const TorqueSegment& segment : segments) {
    const std::vector<double>& torque = (segment.*joint);
    const auto apart = static_cast<std::size_t>(std::llround(lag / segment.period));
    for (std::size_t k = apart; k < torque.size(); ++k, ++pairs) {
      sum += (torque[k - apart] - mean) * (torque[k] - mean);
    }
  }
  return sum / pairs;
}

double autocorrelation_time(const std::vector<TorqueSegment>& segments, Joint joint, double mean,
                            double variance) {
  constexpr double shortest = 0.001;
  constexpr double longest = 10.0;
  for (double lag = shortest; lag <= longest; lag = std::max(lag + shortest, 1.05 * lag)) {
    if (autocovariance(segments, joint, mean, lag) < variance / std::numbers::e) return lag;
  }
  return not_defined;
}

}  // namespace

void add_torques(const RunSignals& run, double skip, TorqueSegments& all) {
  const double period = 1e-6 * static_cast<double>(run.info.control_period_us);
  for (std::size_t leg = 0; leg < models::wheel_count; ++leg) {
    constexpr int gap = 2;
    int last = gap;
    for (auto k = static_cast<std::size_t>(std::llround(skip / period)); k < run.steps(); ++k) {
      const Signals& signals = run.signals[k];
      const int state = has_record(signals) ? run.contact[leg][k] : gap;
      if (state != gap) {
        std::vector<TorqueSegment>& segments = all[static_cast<std::size_t>(state)];
        if (state != last) segments.push_back({period});
        segments.back().knee.push_back(std::abs(signals.leg[leg].knee.torque));
        segments.back().wheel.push_back(std::abs(signals.leg[leg].wheel.torque));
      }
      last = state;
    }
  }
}

TorqueDistribution distribution_of(const std::vector<TorqueSegment>& segments, Joint joint) {
  std::vector<double> all;
  for (const TorqueSegment& segment : segments) {
    all.insert(all.end(), (segment.*joint).begin(), (segment.*joint).end());
  }
  if (all.empty()) {
    return {0,           not_defined, not_defined, {not_defined, not_defined, not_defined},
            not_defined, not_defined};
  }
  std::sort(all.begin(), all.end());
  const auto count = static_cast<double>(all.size());
  TorqueDistribution distribution{.samples = static_cast<std::int64_t>(all.size())};
  for (const double torque : all) distribution.mean += torque / count;
  double variance = 0.0;
  for (const double torque : all) variance += std::pow(torque - distribution.mean, 2) / count;
  distribution.deviation = std::sqrt(variance);
  for (std::size_t q = 0; q < quantiles.size(); ++q) {
    distribution.quantile[q] = all[static_cast<std::size_t>(std::ceil(quantiles[q] * count)) - 1];
  }
  distribution.largest = all.back();
  distribution.autocorrelation_time =
      autocorrelation_time(segments, joint, distribution.mean, variance);
  return distribution;
}

std::vector<double> density_of(const std::vector<TorqueSegment>& segments, Joint joint) {
  std::vector<double> density;
  double steps = 0.0;
  for (const TorqueSegment& segment : segments) {
    for (const double torque : segment.*joint) {
      const auto cell = static_cast<std::size_t>(cell_of(torque));
      if (cell >= density.size()) density.resize(cell + 1, 0.0);
      ++density[cell];
      ++steps;
    }
  }
  for (double& value : density) value /= steps * torque_cell;
  if (!density.empty()) density.front() *= 2.0;
  return density;
}

double overlap(const std::vector<TorqueSegment>& a, const std::vector<TorqueSegment>& b) {
  const SharesByCell in_a = shares_by_cell(a);
  const SharesByCell in_b = shares_by_cell(b);
  if (in_a.empty() || in_b.empty()) return not_defined;
  std::vector<double> p, q;  // in the cells of `a`, outside of which it is zero
  for (const auto& [cell, share] : in_a) {
    const auto other = in_b.find(cell);
    p.push_back(share);
    q.push_back(other == in_b.end() ? 0.0 : other->second);
  }
  return scoring::overlap(p, q);
}

}  // namespace touchdown::experiments
