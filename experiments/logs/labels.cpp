#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <memory>

#include "estimator/signal_guard.hpp"
#include "experiments/logs/estimator.hpp"

namespace touchdown::experiments {

namespace {

/// One interval after the other, of which the last grows.
class Intervals {
 public:
  explicit Intervals(double period)
      : period_(period),
        window_(std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(0.02 / period)))) {}

  void add(double time, const Belief& belief) {
    const std::array<bool, 2> contact = {belief.wheel[0].contact, belief.wheel[1].contact};
    const bool is_gap = !(time - last_ <= SignalGuardConfig{}.maximum_gap);
    if (is_gap || contact != all_.intervals.back().contact) {
      finish(is_gap ? last_ + period_ : time);
      all_.intervals.push_back({.start = time, .contact = contact, .sure = 1.0});
    }
    last_ = time;
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      const double p = belief.wheel[wheel].p_contact;
      probability_[wheel].push_back(contact[wheel] ? p : 1.0 - p);
      sum_[wheel] += probability_[wheel].back();
      if (probability_[wheel].size() > window_) {
        sum_[wheel] -= probability_[wheel].front();
        probability_[wheel].pop_front();
      }
      if (probability_[wheel].size() == window_) keep_least(wheel);
    }
  }

  logs::ContactIntervals finished() {
    finish(last_ + period_);
    return std::move(all_);
  }

 private:
  void keep_least(std::size_t wheel) {
    const double mean = sum_[wheel] / static_cast<double>(probability_[wheel].size());
    double& sure = *all_.intervals.back().sure;
    sure = std::clamp(mean, 0.0, sure);
  }

  /// Ends the last interval, which may be shorter than the window.
  void finish(double end) {
    if (all_.intervals.empty()) return;
    for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
      if (probability_[wheel].size() < window_) keep_least(wheel);
      probability_[wheel].clear();
      sum_[wheel] = 0.0;
    }
    all_.intervals.back().end = end;
  }

  logs::ContactIntervals all_;
  double period_;       ///< s
  std::size_t window_;  ///< steps
  double last_ = -INFINITY;
  std::array<std::deque<double>, models::wheel_count> probability_;  ///< of the decision
  std::array<double, models::wheel_count> sum_ = {};
};

}  // namespace

logs::ContactIntervals proposed_labels(LogSteps& log, const LogEstimator& chosen) {
  const std::unique_ptr<ContactEstimator> estimator = chosen.make(log.sample_rate(), log.info());
  Intervals intervals(log.period());
  double last = -INFINITY;
  while (const LogStep* step = log.next()) {
    const double time = step->signals.time;
    const Belief& belief = estimator->update(step->signals);
    if (!(time > last) || !is_used(belief.status)) continue;
    last = time;
    intervals.add(time, belief);
  }
  return intervals.finished();
}

}  // namespace touchdown::experiments
