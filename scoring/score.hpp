#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "estimator/contact_estimator.hpp"
#include "scoring/calibration.hpp"
#include "scoring/classification.hpp"
#include "scoring/labels.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::scoring {

/// An estimator's output for one view (a wheel, or both combined), one entry per step.
struct Track {
  ContactSequence contact;        ///< its decision
  std::vector<double> p_contact;  ///< its probability
};

/// All counts of one track in one run, or in a part of it. Sums, so scores add.
struct Score {
  Classification points;
  TransitionCounts takeoff;
  TransitionCounts landing;
  Calibration calibration;
  std::int64_t scored_us = 0;  ///< scored time (µs); for pooled wheels, the sum of both

  /// NaN if no time is scored.
  double false_takeoffs_per_minute() const { return 60e6 * ratio(takeoff.false_alarms, scored_us); }

  Score& operator+=(const Score& other);
};

/// The first scored step.
std::size_t first_scored_step(std::int64_t period_us, const ScoringConfig& config);

/// Compares a track with the truth. `segments` holds the first step of each segment of the run:
/// `{0}` for the whole run, `drop_segments` for one per drop. The result has one score per segment.
/// A step belongs to its own segment, a transition to the segment of its true event.
std::vector<Score> score(const ContactSequence& truth, const Track& track,
                         const std::vector<std::size_t>& segments, std::int64_t period_us,
                         const ScoringConfig& config);

/// The point-wise counts alone, from decisions.
std::vector<Classification> classify(const ContactSequence& truth, const ContactSequence& predicted,
                                     const std::vector<std::size_t>& segments,
                                     std::int64_t period_us, const ScoringConfig& config);

/// Views of contact that are scored.
enum class View : int { left_wheel, right_wheel, any_wheel, both_wheels };
inline constexpr std::size_t view_count = 4;
inline constexpr std::array<std::string_view, view_count> view_names = {"left_wheel", "right_wheel",
                                                                        "any_wheel", "both_wheels"};

/// The belief about one view at one step.
struct ViewBelief {
  bool contact;      ///< its decision
  double p_contact;  ///< its probability
};

/// The belief about every view, in the order of `View`.
inline std::array<ViewBelief, view_count> views_of(const Belief& belief) {
  const WheelBelief& left = belief.wheel[0];
  const WheelBelief& right = belief.wheel[1];
  return {{{left.contact, left.p_contact},
           {right.contact, right.p_contact},
           {left.contact || right.contact, belief.p_any_wheel},
           {left.contact && right.contact, belief.p_both_wheels}}};
}

/// An estimator's output for a run, in the order of `View`.
using Prediction = std::array<Track, view_count>;

/// Scores of one segment of a run, in the order of `View`.
struct RobotScore {
  std::array<Score, view_count> view;

  RobotScore& operator+=(const RobotScore& other);
  const Score& operator[](View v) const { return view[static_cast<std::size_t>(v)]; }
  /// Both wheels' scores added. Tables show this unless they name a view.
  Score wheels() const;
};

/// Scores every view of a run, one result per segment.
std::vector<RobotScore> score(const std::array<ContactSequence, models::wheel_count>& truth,
                              const Prediction& prediction,
                              const std::vector<std::size_t>& segments, std::int64_t period_us,
                              const ScoringConfig& config);

}  // namespace touchdown::scoring
