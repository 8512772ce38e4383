#pragma once

#include <cstdint>
#include <vector>

#include "recordings/plausibility/findings.hpp"

namespace touchdown::recordings {

/// Checks the times of a log: stretches at another rate, repeated times, steps back, jumps.
class ClockCheck {
 public:
  /// `period`: between two records, as measured at the beginning of the log (s).
  explicit ClockCheck(double period) : period_(period) {}

  void add(double time);
  void report(Findings& findings) const;

 private:
  void end_window();

  double period_;
  std::vector<double> window_;  ///< times
  double previous_ = 0.0;       ///< NaN before the first time
  bool is_started_ = false;
  std::int64_t repeated_ = 0;
  std::int64_t back_ = 0;
  double furthest_back_ = 0.0;
  std::int64_t jumps_ = 0;
  double longest_jump_ = 0.0;
  std::int64_t windows_ = 0;
  std::int64_t other_rate_ = 0;  ///< windows
  double first_other_ = 0.0;     ///< time of the first of them (s) …
  double other_step_ = 0.0;      ///< … and its step between two records (s)
};

}  // namespace touchdown::recordings
