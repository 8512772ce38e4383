#include "experiments/logs/label_proposal.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown::experiments {

LabelProposal::LabelProposal(double period)
    : period_(period),
      window_(std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(0.02 / period)))) {}

void LabelProposal::add(double time, const Belief& belief) {
  if (std::isfinite(last_ - time)) furthest_back_ = std::max(furthest_back_, last_ - time);
  if (!(time > last_) || !is_used(belief.status)) return;
  const std::array<bool, 2> contact = {belief.wheel[0].contact, belief.wheel[1].contact};
  const bool is_gap = !(time - last_ <= SignalGuardConfig{}.maximum_gap);
  if (is_gap || contact != all_.intervals.back().contact) {
    end_last(is_gap ? last_ + period_ : time);
    all_.intervals.push_back({.start = time, .contact = contact, .sure = 1.0});
  }
  last_ = time;
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    const double p = belief.wheel[wheel].p_contact;
    probability_[wheel].push_back(contact[wheel] ? p : 1.0 - p);
    sum_[wheel] += probability_[wheel].back();
    if (probability_[wheel].size() > window_) {
      sum_[wheel] -= probability_[wheel].front();
      probability_[wheel].pop_front();
    }
    if (probability_[wheel].size() == window_) keep_least(wheel);
  }
}

logs::ContactIntervals LabelProposal::finish() {
  if (furthest_back_ > SignalGuardConfig{}.maximum_gap) {
    throw InputError(
        fmt::format("--propose: time goes back by {:.3g} s, and labels are intervals of one time: "
                    "split the log",
                    furthest_back_));
  }
  end_last(last_ + period_);
  return std::move(all_);
}

bool LabelProposal::has_all(const logs::ContactIntervals& labels) const {
  const auto same = [](double one, double other) {
    return logs::to_microsecond(one) == logs::to_microsecond(other);
  };
  auto proposed = all_.intervals.begin();
  return std::ranges::all_of(labels.intervals, [&](const logs::ContactInterval& label) {
    // Both are in order of time. Editors take `sure` from what a person has looked at.
    while (proposed != all_.intervals.end() && !same(proposed->start, label.start)) ++proposed;
    if (proposed == all_.intervals.end() || !label.sure) return false;
    const bool is_last = std::next(proposed) == all_.intervals.end();
    return same(is_last ? last_ + period_ : proposed->end, label.end) &&
           proposed->contact == label.contact;
  });
}

void LabelProposal::keep_least(std::size_t wheel) {
  const double mean = sum_[wheel] / static_cast<double>(probability_[wheel].size());
  double& sure = *all_.intervals.back().sure;
  sure = std::clamp(mean, 0.0, sure);
}

/// Ends the last interval, which may be shorter than the window.
void LabelProposal::end_last(double end) {
  if (all_.intervals.empty()) return;
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    if (probability_[wheel].size() < window_) keep_least(wheel);
    probability_[wheel].clear();
    sum_[wheel] = 0.0;
  }
  all_.intervals.back().end = end;
}

}  // namespace touchdown::experiments
