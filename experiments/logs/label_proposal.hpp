#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <deque>

#include "estimator/contact_estimator.hpp"
#include "logs/log/contact_intervals.hpp"

namespace touchdown::experiments {

/// Contact of both wheels throughout a log by an estimator's decisions, as labels to correct by
/// hand. An interval's `sure` is the lowest mean probability of a wheel's state over 20 ms in it.
/// Where no step has usable signals for longer than a gap, no interval is.
class LabelProposal {
 public:
  /// `period` between the log's steps (s).
  explicit LabelProposal(double period);

  /// Takes the next step's belief; those of unusable signals, and of times that do not increase,
  /// are left out.
  void add(double time, const Belief& belief);

  /// Errors: `InputError` for a log whose time went back by more than a gap: labels are intervals
  /// of one time.
  logs::ContactIntervals finish();

  /// Whether labels are rows of this proposal that no person has looked at. Call it before
  /// `finish`.
  bool has_all(const logs::ContactIntervals& labels) const;

 private:
  void keep_least(std::size_t wheel);
  void end_last(double end);

  logs::ContactIntervals all_;  ///< of which the last one grows
  double period_;               ///< s
  std::size_t window_;          ///< steps
  double last_ = -INFINITY;
  double furthest_back_ = 0.0;                                       ///< s
  std::array<std::deque<double>, models::wheel_count> probability_;  ///< of the decision
  std::array<double, models::wheel_count> sum_ = {};
};

}  // namespace touchdown::experiments
