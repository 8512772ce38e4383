#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "logs/plausibility/channels.hpp"
#include "logs/plausibility/lateness.hpp"
#include "logs/plausibility/load.hpp"
#include "logs/plausibility/relations.hpp"
#include "logs/sample_times.hpp"

namespace touchdown::logs {

/// Checks the times of a log: stretches at another rate, several clocks, bursts, repeated times,
/// steps back, jumps.
class ClockCheck {
 public:
  /// `period`: between two records, as measured at the beginning of the log (s). `start`: the log's
  /// clock at time 0 (s).
  ClockCheck(double period, double start) : period_(period), start_(start) {}

  void add(double time);
  void report(Findings& findings) const;

 private:
  void end_window();
  void report_repeated(Findings& findings) const;

  double period_;
  double start_;
  std::vector<double> window_;                                  ///< times
  double previous_ = std::numeric_limits<double>::quiet_NaN();  ///< of the record before
  std::int64_t records_ = 0;
  std::int64_t repeated_ = 0;
  std::int64_t back_ = 0;
  double furthest_back_ = 0.0;
  std::int64_t jumps_ = 0;
  double longest_jump_ = 0.0;
  std::int64_t windows_ = 0;
  std::int64_t other_rate_ = 0;  ///< windows
  double first_other_ = 0.0;     ///< time of the first of them (s) …
  double other_step_ = 0.0;      ///< … and its step between two records (s)
  std::int64_t interleaved_windows_ = 0;
  std::string interleaved_;  ///< what the first of them shows
  double tick_ = 0.0;        ///< the least step forwards (s)
  UnpaddedFractions fractions_;
};

/// Finds channels that change at a lower rate than records come, as when a driver repeats its last
/// reading, records that alternate between the values of several publishers, and torques without
/// signs.
class HeldChannels {
 public:
  /// `period`: between two records (s).
  explicit HeldChannels(double period) : period_(period) {}

  void add(const models::Observation& record);
  /// Returns whether torques have signs.
  bool report(Findings& findings) const;

 private:
  static constexpr std::size_t joint_channels = 3;  ///< position, velocity, torque
  static constexpr std::size_t of_joints = joint_channels * models::servo_count;
  static constexpr std::size_t all = of_joints + 3;  ///< of the IMU

  /// The numbers of records between two changes of a channel.
  struct Channel {
    static constexpr std::size_t longest = 64;
    std::array<std::int64_t, longest + 1> gaps = {};
    std::size_t gap = 0;  ///< since the last change
    bool is_started = false;

    void add(bool changes);
    /// The mean of the gaps, if nearly all are alike; 0 for another channel. A channel that
    /// changes in each record has 1.
    double period() const;
    bool is_constant() const;
  };

  /// How far the values of a joint are from the last ones.
  struct Alternation {
    std::array<double, 3> last = {};  ///< positions
    std::array<double, 3> sums = {};  ///< of distances from the last position, the one before, …
    std::int64_t zeros = 0;           ///< changes of the torque from 0 or to 0
    double torque = 0.0;
    double lowest = 0.0;  ///< torque (N·m)
    double highest = 0.0;
    double nearest = 1e9;  ///< torque to 0, other than 0

    /// The number of publishers, if positions alternate; else 1.
    std::size_t publishers(double records) const;
  };

  void report_alternation(Findings& findings) const;
  bool report_signs(Findings& findings) const;
  void report_rates(Findings& findings) const;

  double period_;
  double records_ = 0.0;
  models::Observation last_;
  std::array<Channel, all> channels_ = {};
  std::array<Alternation, models::servo_count> alternations_ = {};
};

/// Of a log that can be judged (s): ten windows, the fewest of which relations are reported.
inline constexpr double shortest_log = 1.0;

/// Checks whether the signals of a log can be those of a wheeled biped. It reads the log record by
/// record, in constant memory. A finding is one line: the channel, what is wrong about it, and the
/// likely cause. The recordings of a simulated robot have no findings, also with bad sensors
/// (noise/profiles/harsh.yaml).
class PlausibilityCheck {
 public:
  /// `period`: between two records (s). `start`: the log's clock at time 0 (s).
  explicit PlausibilityCheck(double period, const CheckedRobot& robot = {}, double start = 0.0,
                             const QuaternionReading& reading = {});

  /// `targets`: the commands of the step before.
  void add(const models::Observation& reported, const ServoTargets& targets = {});

  /// One line per finding so far.
  std::vector<std::string> findings() const;

 private:
  WindowCollector windows_;
  StillStretches still_;
  ClockCheck clock_;
  HeldChannels held_;
  ConstantChannels constant_;
  StoppedChannels stopped_;
  SensorRangeCheck sensor_range_;
  JointRangeCheck joint_range_;
  Relations relations_;
  Lateness lateness_;
  LoadRelation load_;
  ChatterCheck chatter_;
};

}  // namespace touchdown::logs
