#pragma once

#include <cstdint>
#include <optional>

#include "experiments/logs/log_steps.hpp"
#include "scoring/score_stream.hpp"

namespace touchdown::experiments {

/// The score of beliefs about a log, against its ground truth or what somebody says of stretches of
/// it: each of those is scored as a run, without what `scoring.skip` leaves out of the log.
class LogScore {
 public:
  /// `segment_counts`: the truth may be known of a part of the log; otherwise of all or nothing.
  LogScore(std::int64_t period_us, const scoring::LabelConfig& labels,
           const scoring::ScoringConfig& scoring, bool segment_counts);

  void add(const LogStep& step, const Belief& belief);

  /// The log is over. Nothing where there is no truth.
  std::optional<scoring::RobotScore> finish();

 private:
  void end_segment();

  std::int64_t period_us_;
  scoring::LabelConfig labels_;
  scoring::ScoringConfig scoring_;
  bool segment_counts_;
  bool is_scored_ = true;
  std::int64_t steps_ = 0;
  std::optional<scoring::ScoreStream> duration_;
  std::optional<scoring::RobotScore> total_;
};

}  // namespace touchdown::experiments
