#pragma once

#include <cstdint>
#include <optional>

#include "experiments/logs/log_steps.hpp"
#include "scoring/score.hpp"

namespace touchdown::experiments {

/// The score of beliefs about a log, against its ground truth or against labels of segments. Each
/// segment is scored as a run; `scoring.skip` applies to the beginning of the log.
class LogScore {
 public:
  /// `segment_counts`: ground truth of a part of the log suffices; otherwise all of it is needed.
  LogScore(std::int64_t period_us, const scoring::LabelConfig& labels,
           const scoring::ScoringConfig& scoring, bool segment_counts);

  void add(const LogStep& step, const Belief& belief);

  /// Ends the log. Returns nothing without ground truth.
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
