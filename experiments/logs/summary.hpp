#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "estimator/contact_estimator.hpp"
#include "scoring/score.hpp"

namespace touchdown::experiments {

/// Counts an estimator's results on a log. It keeps only the first takeoffs and landings, so its
/// memory does not grow with the log. In the first `scoring.skip` seconds it counts the signals'
/// status alone: there, beliefs still depend on the prior.
class LogSummary {
 public:
  /// `period` in seconds.
  LogSummary(double period, const scoring::ScoringConfig& scoring);

  void add(double time, const Belief& belief);

  std::int64_t steps() const { return steps_; }

  /// A few lines, each with a line end: time, contact, takeoffs and landings, signals, and the
  /// score if the log has ground truth. `start` is the log's clock at time 0 (s).
  std::string text(const std::optional<scoring::RobotScore>& score, double start = 0.0) const;

 private:
  /// One kind of transition of one wheel.
  struct Events {
    std::int64_t count = 0;
    std::vector<double> first;  ///< times (s)
    void add(double time);
    std::string text() const;
  };

  /// Range, gaps and backward steps of a log's times.
  struct Clock {
    double period = 0.0;
    double first = 0.0, last = 0.0, previous = 0.0;  ///< NaN before the first step
    double lost = 0.0;                               ///< time without records
    std::int64_t steps_back = 0;
    void add(double time);
    std::string text(double start) const;
  };

  std::string contact_text() const;
  std::string events_text(std::size_t wheel) const;
  std::string signals_text() const;

  Clock clock_;
  /// Steps with an invalid status, by their first unusable signal.
  std::array<std::int64_t, signal_count> unusable_{};
  std::int64_t skipped_;
  std::int64_t steps_ = 0;
  std::array<std::int64_t, scoring::view_count> contact_{};
  std::array<std::int64_t, 4> status_{};
  std::array<bool, 2> was_in_contact_{};
  std::array<Events, 2> takeoffs_;
  std::array<Events, 2> landings_;
};

}  // namespace touchdown::experiments
