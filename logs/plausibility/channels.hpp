#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "estimator/force/leg_geometry.hpp"
#include "estimator/signal_bounds.hpp"
#include "estimator/stopped_signals.hpp"
#include "logs/plausibility/findings.hpp"
#include "models/robot.hpp"

namespace touchdown::logs {

/// The positions that a joint can reach (rad).
struct JointRange {
  double lowest = 0.0;
  double highest = 0.0;
};
using JointRanges = std::array<JointRange, models::servo_count>;

/// What the checks of a log know about its robot. Without legs or ranges, Upkie's are assumed, with
/// wider limits.
struct CheckedRobot {
  std::optional<LegGeometry> legs = {};
  std::optional<JointRanges> ranges = {};  ///< wheels have none, and are not checked
  std::string doubt = {};  ///< why this may not be the robot of the log; empty without a doubt
};

/// Checks every value of a record against the largest that a sensor can report (`SignalBounds`).
class SensorRangeCheck {
 public:
  /// Returns the record with NaN in place of every value beyond its bound, and of a quaternion of
  /// another length than 1.
  models::Observation add(const models::Observation& record);
  void report(Findings& findings) const;

 private:
  /// The values of one channel beyond its bound.
  struct Beyond {
    std::int64_t count = 0;
    double first = 0.0;
    double time = 0.0;  ///< of the first (s)
  };

  /// Position, velocity and torque of the joints; orientation, angular velocity, linear and proper
  /// acceleration.
  std::array<Beyond, 3 * models::servo_count + 4> channels_ = {};
};

/// Checks that hips and knees stay within their range.
class JointRangeCheck {
 public:
  explicit JointRangeCheck(const CheckedRobot& robot);

  void add(const models::Observation& record);
  /// Returns whether all joints are within their range.
  bool report(Findings& findings) const;

 private:
  JointRanges range_;
  JointRanges found_;
};

/// Finds channels that report the same number throughout a log, or often none: a dead sensor, or a
/// column that was filled with zeros. A position may rest; it counts only if its joint reports that
/// it moves.
class ConstantChannels {
 public:
  void add(const models::Observation& record);
  /// Returns whether all accelerations change.
  bool report(Findings& findings) const;
  /// Whether both hips are 0 throughout: a mapping with `hip: none` fills in joints that the robot
  /// lacks.
  bool lacks_hips() const;

 private:
  /// One number per record.
  struct Channel {
    double first = 0.0;
    double sum_of_sizes = 0.0;
    std::int64_t count = 0;
    std::int64_t missing = 0;
    bool changes = false;

    void add(double value);
    bool is_constant() const;
    bool is_zero() const { return is_constant() && first == 0.0; }
  };
  static void report_missing(std::string_view subject, const char* channel, const Channel& of_log,
                             Findings& findings, const char* expected = "a finite number");
  void report_joint(std::size_t servo, Findings& findings) const;
  static bool report_vector(const char* name, const std::array<Channel, 3>& axes,
                            Findings& findings);

  std::array<std::array<Channel, 3>, models::servo_count> joints_;  ///< position, velocity, torque
  std::array<Channel, 4> orientation_;
  std::array<Channel, 3> angular_velocity_;
  std::array<Channel, 3> linear_acceleration_;
  std::array<Channel, 3> proper_acceleration_;
};

/// Finds channels that stop within a log: they repeat themselves although the robot moves.
class StoppedChannels {
 public:
  void add(const models::Observation& record);
  void report(Findings& findings) const;

 private:
  /// The stretches in which a channel stands still.
  struct Channel {
    double first = 0.0;  ///< begin of the first of them (s)
    double value = 0.0;
    int stretches = 0;
    bool is_stopped = false;

    void add(bool stops, double since, double at);
  };

  StoppedSignals stopped_;
  StoppedSignals proper_;                  ///< with the accelerations before gravity is removed
  std::array<Channel, 24> channels_ = {};  ///< of joints and IMU
  Channel orientation_;
  Eigen::Quaterniond last_ = Eigen::Quaterniond::Identity();
  double since_ = 0.0;                                 ///< the orientation repeats itself (s)
  double time_ = 0.0;                                  ///< of the last record (s)
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();     ///< of the gyroscope, smoothed (rad/s)
  Eigen::Vector3d turned_ = Eigen::Vector3d::Zero();   ///< by it since then (rad)
  Eigen::Vector3d squares_ = Eigen::Vector3d::Zero();  ///< of the smoothed rate, times time
};

/// Finds servos in a limit cycle: their torque changes its sign in most records. Noise about zero
/// changes it in half of them.
class ChatterCheck {
 public:
  void add(const models::Observation& record);
  void report(Findings& findings) const;

 private:
  struct Joint {
    double last = 0.0;      ///< torque (N·m)
    double changing = 0.5;  ///< share of recent records that change the torque's sign
    bool cycles = false;
  };
  std::array<Joint, models::servo_count> joints_;
  double since_ = std::numeric_limits<double>::quiet_NaN();  ///< of the first limit cycle (s)
};

}  // namespace touchdown::logs
