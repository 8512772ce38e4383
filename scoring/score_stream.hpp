#pragma once

#include <array>
#include <cstdint>

#include "estimator/contact_estimator.hpp"
#include "scoring/labels.hpp"
#include "scoring/score.hpp"

namespace touchdown::scoring {

/// `score` of a whole run for beliefs and forces that arrive one by one, with a memory that does
/// not grow with the run. The run is scored in segments. Each ends where truth and decisions have
/// been constant for longer than every window of docs/reference/metrics.md, so the sum is the score
/// of the run. (Without such a place for five minutes, the segment ends anyway, and an event near
/// its end is not counted.)
class ScoreStream {
 public:
  ScoreStream(std::int64_t period_us, const LabelConfig& labels, const ScoringConfig& scoring);

  /// Adds one step: normal force on both wheels (N) and the belief.
  void add(const std::array<double, models::wheel_count>& normal_force, const Belief& belief);

  /// Ends the run and returns its score.
  RobotScore finish();

 private:
  void cut_if_quiet();
  void score_until(std::size_t end);

  std::int64_t period_us_;
  ScoringConfig scoring_;
  std::size_t margin_;
  std::size_t next_attempt_;
  std::size_t retry_after_;
  std::size_t longest_;
  std::array<LabelStream, models::wheel_count> labels_;
  std::array<ContactSequence, models::wheel_count>
      truth_;              ///< of the current segment, as far as it is known
  Prediction prediction_;  ///< of the current segment
  RobotScore total_;
};

}  // namespace touchdown::scoring
