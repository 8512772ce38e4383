#include "experiments/logs/log_score.hpp"

#include <algorithm>

namespace touchdown::experiments {

LogScore::LogScore(std::int64_t period_us, const scoring::LabelConfig& labels,
                   const scoring::ScoringConfig& scoring, bool segment_counts)
    : period_us_(period_us), labels_(labels), scoring_(scoring), segment_counts_(segment_counts) {}

void LogScore::add(const LogStep& step, const Belief& belief) {
  const double time = 1e-6 * static_cast<double>(period_us_ * steps_++);
  if (!step.normal_force) {
    is_scored_ = is_scored_ && segment_counts_;
    end_segment();
    return;
  }
  if (!is_scored_) return;
  if (!duration_) {
    scoring::ScoringConfig scoring = scoring_;
    scoring.skip = std::max(0.0, scoring_.skip - time);
    duration_.emplace(period_us_, labels_, scoring);
  }
  duration_->add(*step.normal_force, belief);
}

std::optional<scoring::RobotScore> LogScore::finish() {
  end_segment();
  return is_scored_ ? total_ : std::nullopt;
}

void LogScore::end_segment() {
  if (!duration_) return;
  if (!total_) total_.emplace();
  *total_ += duration_->finish();
  duration_.reset();
}

}  // namespace touchdown::experiments
