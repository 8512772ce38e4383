#include "cli/estimate/listeners.hpp"

#include "experiments/logs/estimator.hpp"

namespace touchdown::cli {

EstimateListeners::EstimateListeners(std::ostream* csv, std::ostream* mpack,
                                     const std::optional<DrawnPart>& drawn)
    : drawn_(drawn) {
  if (csv != nullptr) csv_.emplace(*csv);
  if (mpack != nullptr) annotator_.emplace(*mpack);
}

void EstimateListeners::begin(const experiments::LogListener& log) {
  summary_.emplace(log.period(), scoring::ScoringConfig{});
  score_.emplace(log.period_us(), labels_, scoring::ScoringConfig{});
}

void EstimateListeners::listen(const recordings::LogReader& reader,
                               const experiments::LogStep& step, const ContactEstimator& estimator,
                               const Belief& belief) {
  const double time = step.signals.time;
  summary_->add(time, belief);
  // A score needs the truth about every step.
  if (!step.normal_force) score_.reset();
  if (score_) score_->add(*step.normal_force, belief);
  if (!csv_ && !annotator_ && !drawn_) return;
  const recordings::LogBeliefs beliefs = experiments::log_beliefs(estimator, belief);
  if (csv_) csv_->write(time, beliefs);
  if (annotator_) {
    annotator_->copy(reader.skipped());
    annotator_->annotate(reader.record(), reader.outline(), beliefs);
  }
  if (drawn_ && time >= drawn_->from && time <= drawn_->to) draw(step, belief, beliefs);
}

void EstimateListeners::flush() {
  if (csv_) csv_->flush();
}

std::string EstimateListeners::finish(const recordings::LogReader& reader) {
  flush();
  if (annotator_) annotator_->copy(reader.skipped());
  const bool has_truth = score_ && summary_->steps() > 0;
  return summary_->text(has_truth ? std::optional(score_->finish()) : std::nullopt);
}

void EstimateListeners::draw(const experiments::LogStep& step, const Belief& belief,
                             const recordings::LogBeliefs& beliefs) {
  render::LogTraceStep drawn = render::log_trace_step(
      step.signals, belief, beliefs.p_takeoff_p_switch, beliefs.p_landing_p_switch);
  if (step.normal_force) {
    drawn.touches = {(*step.normal_force)[0] > labels_.force_threshold,
                     (*step.normal_force)[1] > labels_.force_threshold};
  }
  trace_.add(drawn);
}

}  // namespace touchdown::cli
