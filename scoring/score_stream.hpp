#pragma once

#include <array>
#include <cstdint>

#include "estimator/contact_estimator.hpp"
#include "scoring/labels.hpp"
#include "scoring/score.hpp"

namespace touchdown::scoring {

/// `score` of a whole run for beliefs and forces that come one by one, at a memory that does not
/// grow with the run. The run is scored in pieces that end where neither the truth nor a decision
/// has changed for so long that no window of docs/metrics.md reaches over the end, so the sum is
/// the score of the run. (Should there be no such place for five minutes, the piece ends all the
/// same, and an event next to its end is not judged.)
class ScoreStream {
 public:
  ScoreStream(std::int64_t period_us, const LabelConfig& labels, const ScoringConfig& scoring);

  /// One step: normal force on both wheels (N) and what was believed.
  void add(const std::array<double, models::wheel_count>& normal_force, const Belief& belief);

  /// The run is over.
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
  std::array<ContactSequence, models::wheel_count> truth_;  ///< of the piece, as far as it is known
  Prediction prediction_;                                   ///< of the piece
  RobotScore total_;
};

}  // namespace touchdown::scoring
