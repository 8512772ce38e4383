#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "estimator/contact_estimator.hpp"
#include "experiments/logs/log_steps.hpp"
#include "logs/log/mcap.hpp"
#include "scoring/extended_score.hpp"
#include "scoring/labels.hpp"
#include "scoring/score.hpp"

namespace touchdown::experiments {

/// The header of beliefs as comma-separated values.
inline constexpr std::string_view belief_columns =
    "time_s,p_contact_left,p_contact_right,contact_left,contact_right,p_any_wheel,p_both_wheels,"
    "p_takeoff,p_landing,status,load_left_n,load_right_n,load_deviation_left_n,"
    "load_deviation_right_n,stamp_ns\n";

/// Writes the line of a step: time (s), contact probability and decision (1 or 0) of each wheel,
/// P(any wheel in contact), P(both wheels in contact), P(takeoff) and P(landing) of the transition
/// model, status, normal force of each wheel and its standard deviation (N), the stamp of the log's
/// own clock (ns). Numbers are the shortest that read back to the same bits; `nan` stands for
/// values that an estimator does not compute.
void write_csv(std::ostream& stream, double time, std::int64_t stamp, const Belief& belief,
               const Evidence& evidence);

/// Writes beliefs as a ROS 2 bag (MCAP), to be played beside the log: sensor_msgs/msg/JointState,
/// which every installation knows, on /touchdown/contact, stamped by the log's clock. Names are
/// left_wheel and right_wheel; position is the contact probability, velocity the decision (1 or 0),
/// effort the normal force (N).
class BeliefBag {
 public:
  /// `stream` must outlive this.
  explicit BeliefBag(std::ostream& stream);

  /// `stamp`: the log's clock (ns).
  void write(std::int64_t stamp, const Belief& belief);
  /// Ends the file. Call it once.
  void finish() { writer_.finish(); }

 private:
  logs::McapWriter writer_;
  std::uint16_t topic_;
};

/// The score of beliefs about a log, against its ground truth or against labels of segments. Each
/// segment is scored as a run; `scoring.skip` applies to the beginning of the log. A scored step
/// takes 100 bytes until its segment ends.
class LogScore {
 public:
  /// `segment_counts`: ground truth of a part of the log suffices; otherwise all of it is needed.
  /// `robot_mass` in kg, for the labels.
  LogScore(std::int64_t period_us, const scoring::LabelConfig& labels, double robot_mass,
           const scoring::ScoringConfig& scoring, bool segment_counts);

  /// `normal_force` is known or nothing and `truth` the log's own, as in `LogStep`.
  void add(const std::optional<std::array<double, models::wheel_count>>& normal_force,
           const std::optional<std::array<double, models::wheel_count>>& truth,
           const Belief& belief);

  /// Ends the log. Returns nothing without ground truth.
  std::optional<scoring::RobotScore> finish();

  /// Of the steps with a true normal force, else of those that labels state to be without contact;
  /// a line of text, empty without any.
  std::string load_text() const;

 private:
  void end_segment();

  std::int64_t period_us_;
  scoring::LabelConfig labels_;
  double robot_mass_;
  scoring::ScoringConfig scoring_;
  bool segment_counts_;
  bool is_scored_ = true;
  std::int64_t steps_ = 0;
  std::array<std::vector<double>, models::wheel_count> force_;  ///< of the segment (N)
  scoring::Prediction segment_;
  double start_ = 0.0;  ///< of the segment (s)
  std::optional<scoring::RobotScore> total_;
  scoring::LoadScore load_;
  bool is_load_of_air_ = false;  ///< labels do not state the force in contact
};

/// Counts an estimator's results on a log. It keeps only the first takeoffs and landings, so its
/// memory does not grow with the log. Only steps with good signals count: what is invalid is no
/// contact information. In the first `scoring.skip` seconds it counts the signals' status alone:
/// there, beliefs still depend on the prior. A takeoff and a landing enclose a flight of at least
/// `scoring.minimum_flight`, as those of the score do; a state that ends sooner does not count, and
/// the switches of the raw decision are counted beside them.
class LogSummary {
 public:
  /// `period` in seconds.
  LogSummary(double period, const scoring::ScoringConfig& scoring);

  void add(double time, const Belief& belief);

  std::int64_t steps() const { return steps_; }
  /// Steps with good signals.
  std::int64_t valid_steps() const {
    return steps_with(SignalStatus::good) + steps_with(SignalStatus::degraded);
  }
  /// From the first to the last step by the log's clock, one step more (s).
  double duration() const { return std::isnan(first_) ? 0.0 : last_ - first_ + period_; }

  /// Ends the log. A few lines, each with a line end: time, contact, takeoffs and landings,
  /// signals, and the score if the log has ground truth. `start` is the log's clock at time 0 (s),
  /// `findings` the number of lines about implausible signals (logs/plausibility/check.hpp).
  std::string text(const std::optional<scoring::RobotScore>& score, double start = 0.0,
                   std::size_t findings = 0) const;

 private:
  /// The decisions about one wheel. One counts once it has held for `shortest_` steps, from its
  /// first one. After signals were missing for long, the next is no event.
  struct Wheel {
    std::optional<bool> raw, lasting;
    std::int64_t held = 0;                     ///< steps of the raw decision
    double since = 0.0;                        ///< its first time (s)
    std::int64_t switches = 0;                 ///< of the raw decision
    std::array<std::int64_t, 2> events{};      ///< takeoffs, landings
    std::array<std::vector<double>, 2> first;  ///< their times (s), as far as they are listed
  };

  void add_time(double time);
  void add_decision(double time, bool contact, Wheel& wheel) const;
  std::string time_text(double start) const;
  std::string contact_text() const;
  std::string signals_text(std::size_t findings) const;
  std::int64_t steps_with(SignalStatus status) const {
    return status_[static_cast<std::size_t>(status)];
  }

  double period_;
  std::int64_t skipped_, longest_bridged_, shortest_;      ///< steps
  double first_ = NAN, last_ = NAN, previous_ = NAN;       ///< times; NaN before the first step
  double lost_ = 0.0;                                      ///< time without records
  std::int64_t gaps_ = 0, steps_back_ = 0, repeated_ = 0;  ///< of the times
  std::int64_t steps_ = 0;
  std::array<std::int64_t, 5> status_{};  ///< steps
  /// Steps with an invalid status, by their first unusable signal.
  std::array<std::int64_t, signal_count> unusable_{};
  bool first_is_degraded_ = false;  ///< the first record has no command before it
  std::int64_t counted_ = 0;        ///< valid steps after the skipped ones
  std::array<std::int64_t, scoring::view_count> contact_{};
  std::int64_t invalid_in_a_row_ = 0;
  std::array<Wheel, 2> wheels_;
};

}  // namespace touchdown::experiments
