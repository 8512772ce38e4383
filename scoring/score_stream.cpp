#include "scoring/score_stream.hpp"

#include <algorithm>
#include <cmath>

namespace touchdown::scoring {

namespace {

/// The last step with `margin` steps on either side over which no sequence changes; 0 if none.
std::size_t quiet_step(const std::array<const ContactSequence*, 4>& sequences, std::size_t known,
                       std::size_t margin) {
  std::size_t end = known;  // end of the interval without changes that contains step k
  for (std::size_t k = known; k-- > 1;) {
    if (end - k > 2 * margin) return k + margin;
    const bool changes = std::any_of(sequences.begin(), sequences.end(),
                                     [k](const auto* s) { return (*s)[k] != (*s)[k - 1]; });
    if (changes) end = k;
  }
  return 0;
}

/// Removes the first `count` entries from `sequence` and returns them.
template <typename Sequence>
Sequence take_front(Sequence& sequence, std::size_t count) {
  const auto end = sequence.begin() + static_cast<std::ptrdiff_t>(count);
  Sequence front(sequence.begin(), end);
  sequence.erase(sequence.begin(), end);
  return front;
}

}  // namespace

ScoreStream::ScoreStream(std::int64_t period_us, const LabelConfig& labels,
                         const ScoringConfig& scoring)
    : period_us_(period_us),
      scoring_(scoring),
      labels_{LabelStream(1e-6 * static_cast<double>(period_us), labels,
                          [this](std::uint8_t contact) { truth_[0].push_back(contact); }),
              LabelStream(1e-6 * static_cast<double>(period_us), labels,
                          [this](std::uint8_t contact) { truth_[1].push_back(contact); })} {
  const auto steps = [period_us](double seconds) {
    return static_cast<std::size_t>(std::ceil(1e6 * seconds / static_cast<double>(period_us)));
  };
  margin_ = steps(scoring.hold_off + scoring.takeoff_opens + scoring.landing_opens +
                  scoring.minimum_flight) +
            2;
  retry_after_ = steps(10.0);
  next_attempt_ = retry_after_ + steps(scoring.skip) + 2 * margin_;
  longest_ = steps(300.0);
}

void ScoreStream::add(const std::array<double, models::wheel_count>& normal_force,
                      const Belief& belief) {
  const auto views = views_of(belief);
  for (std::size_t v = 0; v < view_count; ++v) {
    prediction_[v].contact.push_back(std::uint8_t{views[v].contact});
    prediction_[v].p_contact.push_back(views[v].p_contact);
  }
  for (std::size_t wheel = 0; wheel < labels_.size(); ++wheel) {
    labels_[wheel].add(normal_force[wheel]);
  }
  if (prediction_[0].contact.size() >= next_attempt_) cut_if_quiet();
}

void ScoreStream::cut_if_quiet() {
  const std::size_t known = std::min(truth_[0].size(), truth_[1].size());
  // Decisions about any and both wheels change only with a wheel's decision.
  std::size_t end = quiet_step(
      {&truth_[0], &truth_[1], &prediction_[0].contact, &prediction_[1].contact}, known, margin_);
  if (end < first_scored_step(period_us_, scoring_) + margin_) end = 0;
  if (end == 0 && known >= longest_) end = known;
  if (end > 0) score_until(end);
  next_attempt_ = prediction_[0].contact.size() + retry_after_;
}

void ScoreStream::score_until(std::size_t end) {
  std::array<ContactSequence, models::wheel_count> truth;
  Prediction prediction;
  for (std::size_t wheel = 0; wheel < truth.size(); ++wheel) {
    truth[wheel] = take_front(truth_[wheel], end);
  }
  for (std::size_t v = 0; v < view_count; ++v) {
    prediction[v] = {take_front(prediction_[v].contact, end),
                     take_front(prediction_[v].p_contact, end)};
  }
  total_ += score(truth, prediction, {0}, period_us_, scoring_).front();
  scoring_.skip = 0.0;  // only the beginning of the run is skipped, not that of a segment
}

RobotScore ScoreStream::finish() {
  for (LabelStream& labels : labels_) labels.finish();
  score_until(truth_[0].size());
  return total_;
}

}  // namespace touchdown::scoring
