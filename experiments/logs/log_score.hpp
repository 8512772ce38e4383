#pragma once

#include <cstdint>
#include <optional>

#include "experiments/logs/listener.hpp"
#include "scoring/score_stream.hpp"

namespace touchdown::experiments {

/// The score of beliefs about a log, against its ground truth or what somebody says of stretches of
/// it: each of those is scored as a run, without what `scoring.skip` leaves out of the log.
class LogScore {
 public:
  /// `of_stretches`: the truth may be known of a part of the log; otherwise of all or nothing.
  LogScore(std::int64_t period_us, const scoring::LabelConfig& labels,
           const scoring::ScoringConfig& scoring, bool of_stretches);

  void add(const LogStep& step, const Belief& belief);

  /// The log is over. Nothing where there is no truth.
  std::optional<scoring::RobotScore> finish();

 private:
  void end_stretch();

  std::int64_t period_us_;
  scoring::LabelConfig labels_;
  scoring::ScoringConfig scoring_;
  bool of_stretches_;
  bool is_scored_ = true;
  std::int64_t steps_ = 0;
  std::optional<scoring::ScoreStream> stretch_;
  std::optional<scoring::RobotScore> total_;
};

}  // namespace touchdown::experiments
