#include "experiments/logs/log_score.hpp"

#include <algorithm>

namespace touchdown::experiments {

LogScore::LogScore(std::int64_t period_us, const scoring::LabelConfig& labels,
                   const scoring::ScoringConfig& scoring, bool of_stretches)
    : period_us_(period_us), labels_(labels), scoring_(scoring), of_stretches_(of_stretches) {}

void LogScore::add(const LogStep& step, const Belief& belief) {
  const double time = 1e-6 * static_cast<double>(period_us_ * steps_++);
  if (!step.normal_force) {
    is_scored_ = is_scored_ && of_stretches_;
    end_stretch();
    return;
  }
  if (!is_scored_) return;
  if (!stretch_) {
    scoring::ScoringConfig scoring = scoring_;
    scoring.skip = std::max(0.0, scoring_.skip - time);
    stretch_.emplace(period_us_, labels_, scoring);
  }
  stretch_->add(*step.normal_force, belief);
}

std::optional<scoring::RobotScore> LogScore::finish() {
  end_stretch();
  return is_scored_ ? total_ : std::nullopt;
}

void LogScore::end_stretch() {
  if (!stretch_) return;
  if (!total_) total_.emplace();
  *total_ += stretch_->finish();
  stretch_.reset();
}

}  // namespace touchdown::experiments
