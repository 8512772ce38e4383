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

/// What an estimator said about one thing that can be in contact, one entry per step.
struct Track {
  ContactSequence contact;        ///< its decision
  std::vector<double> p_contact;  ///< its probability
};

/// Everything counted about one track in one run, or in a part of it; sums, so scores add.
struct Score {
  Classification points;
  TransitionCounts takeoff;
  TransitionCounts landing;
  Calibration calibration;
  std::int64_t scored_us =
      0;  ///< time that was scored (µs); of both wheels pooled, the sum of both

  /// NaN where no time was scored.
  double false_takeoffs_per_minute() const { return 60e6 * ratio(takeoff.false_alarms, scored_us); }

  Score& operator+=(const Score& other);
};

/// The first step that is scored.
std::size_t first_scored_step(std::int64_t period_us, const ScoringConfig& config);

/// Compares a track with the truth. `segments` holds the first step of each piece the run is cut into
/// (`{0}` for the whole run, `drop_segments` for one per drop); the result has one score per piece. A
/// point belongs to the piece it lies in, a transition to the piece of its true event.
std::vector<Score> score(const ContactSequence& truth, const Track& track,
                         const std::vector<std::size_t>& segments, std::int64_t period_us,
                         const ScoringConfig& config);

/// The point-wise part alone, from decisions.
std::vector<Classification> classify(const ContactSequence& truth, const ContactSequence& predicted,
                                     const std::vector<std::size_t>& segments, std::int64_t period_us,
                                     const ScoringConfig& config);

/// The things of which contact is scored.
enum class View : int { left_wheel, right_wheel, any_wheel, both_wheels };
inline constexpr std::size_t view_count = 4;
inline constexpr std::array<std::string_view, view_count> view_names = {"left_wheel", "right_wheel",
                                                                        "any_wheel", "both_wheels"};

/// What a belief says of one view at one step.
struct ViewBelief {
  bool contact;      ///< its decision
  double p_contact;  ///< its probability
};

/// In the order of `View`.
inline std::array<ViewBelief, view_count> views_of(const Belief& belief) {
  const WheelBelief& left = belief.wheel[0];
  const WheelBelief& right = belief.wheel[1];
  return {{{left.contact, left.p_contact},
           {right.contact, right.p_contact},
           {left.contact || right.contact, belief.p_any_wheel},
           {left.contact && right.contact, belief.p_both_wheels}}};
}

/// What an estimator said about a run, in the order of `View`.
using Prediction = std::array<Track, view_count>;

/// Scores of one piece of a run, in the order of `View`.
struct RobotScore {
  std::array<Score, view_count> view;

  RobotScore& operator+=(const RobotScore& other);
  const Score& operator[](View v) const { return view[static_cast<std::size_t>(v)]; }
  /// Both wheels' scores added: the number that a table shows when it says nothing else.
  Score wheels() const;
};

/// Scores every view of a run, one result per piece.
std::vector<RobotScore> score(const std::array<ContactSequence, models::wheel_count>& truth,
                              const Prediction& prediction, const std::vector<std::size_t>& segments,
                              std::int64_t period_us, const ScoringConfig& config);

}  // namespace touchdown::scoring
