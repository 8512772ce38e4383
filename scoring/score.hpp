#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "estimator/contact_estimator.hpp"
#include "scoring/classification.hpp"
#include "scoring/events.hpp"
#include "scoring/labels.hpp"
#include "scoring/transitions.hpp"

namespace touchdown::scoring {

/// Calibration of the probability of contact: the Brier score and the reliability curve of
/// docs/reference/metrics.md, "Calibration". All members are sums over steps, so they add.
struct Calibration {
  static constexpr std::size_t bins = 10;

  /// Steps with a probability in [b/10, (b+1)/10); the last bin is closed.
  struct Bin {
    std::int64_t points = 0;
    std::int64_t contact = 0;
    double probability_sum = 0.0;

    Bin& operator+=(const Bin& other) {
      points += other.points;
      contact += other.contact;
      probability_sum += other.probability_sum;
      return *this;
    }
    double mean_probability() const { return probability_sum / static_cast<double>(points); }
    double contact_frequency() const {
      return static_cast<double>(contact) / static_cast<double>(points);
    }
  };

  std::array<Bin, bins> bin;
  double squared_error = 0.0;
  std::int64_t points = 0;

  void add(bool truth, double p_contact) {
    const double error = p_contact - (truth ? 1.0 : 0.0);
    squared_error += error * error;
    points += 1;
    const auto b = std::min(static_cast<std::size_t>(std::max(p_contact, 0.0) * bins), bins - 1);
    bin[b].points += 1;
    bin[b].contact += truth ? 1 : 0;
    bin[b].probability_sum += p_contact;
  }

  Calibration& operator+=(const Calibration& other) {
    for (std::size_t b = 0; b < bins; ++b) {
      bin[b].points += other.bin[b].points;
      bin[b].contact += other.bin[b].contact;
      bin[b].probability_sum += other.bin[b].probability_sum;
    }
    squared_error += other.squared_error;
    points += other.points;
    return *this;
  }

  /// Expected calibration error: mean |mean probability − share of contact| over the bins, weighted
  /// by their points; NaN without points.
  double expected_error() const {
    double sum = 0.0;
    for (const Bin& b : bin) {
      if (b.points > 0) sum += std::abs(b.probability_sum - static_cast<double>(b.contact));
    }
    return sum / static_cast<double>(points);
  }

  /// Mean squared error of the probability; NaN without points.
  double brier() const { return squared_error / static_cast<double>(points); }
};

/// An estimator's output for one view (a wheel, or both combined), one entry per step.
struct Track {
  ContactSequence contact;           ///< its decision
  std::vector<double> p_contact;     ///< its probability
  std::vector<WheelLoad> load = {};  ///< of a wheel; empty where unknown
};

/// All counts of one track in one run, or in a part of it. Sums, so scores add.
struct Score {
  Classification points;
  EventScore events;
  TransitionCounts takeoff;
  TransitionCounts landing;
  Calibration calibration;
  std::int64_t scored_us = 0;  ///< scored time (µs); for pooled wheels, the sum of both

  // Per minute of scored time of a wheel; NaN if no time is scored.
  double false_takeoffs_per_minute() const { return 60e6 * ratio(takeoff.false_alarms, scored_us); }
  double extra_switches_per_minute() const { return 60e6 * ratio(events.extra, scored_us); }
  double long_errors_s_per_minute() const { return 60.0 * ratio(events.wrong_us, scored_us); }

  Score& operator+=(const Score& other);
};

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

/// Adds the belief after the next step, with loads.
void add_step(Prediction& prediction, const Belief& belief);

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

/// A number computed from a score; NaN where it is not defined. docs/reference/metrics.md defines
/// the counts.
struct Metric {
  std::string name;  ///< as in a CSV header, unit last
  std::function<double(const Score&)> of;
  /// The number of events in the denominator, if the metric is a share of events.
  std::function<std::int64_t(const Score&)> events = {};
};

/// All metrics, in the order of the tables: ranking, classification, transitions, latency,
/// calibration.
const std::vector<Metric>& metrics();
/// Index of the metric with this name. Errors: `InputError` naming the nearest one.
std::size_t metric_index(std::string_view name);

/// Names of the views that are scored: both wheels pooled, then the views of `RobotScore`.
const std::vector<std::string>& scored_views();
/// The score of a view, by its index in `scored_views()`.
Score score_of_view(const RobotScore& robot, std::size_t view);

}  // namespace touchdown::scoring
