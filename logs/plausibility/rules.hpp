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
#include "models/robot.hpp"

namespace touchdown::logs {

/// What is implausible about a log: one line per finding. Subjects with the same finding share its
/// line: "left_knee, right_knee: torque is 0 throughout".
class Findings {
 public:
  void add(std::string_view subject, const std::string& finding);

  /// In the order in which the findings were added.
  std::vector<std::string> lines() const;

 private:
  struct Finding {
    std::string text;
    std::vector<std::string> subjects;
  };
  std::vector<Finding> findings_;
};

/// The commands that the servos executed when a record was measured. NaN: not known.
using ServoTargets = std::array<LegTargets, 2>;

/// Means of consecutive records over a tenth of a second. It is long enough to average noise and
/// resolution, and short enough to follow the motion of a robot. Values are NaN if one of the
/// records lacks them.
struct CheckedWindow {
  double start = 0.0;     ///< time of the first record (s)
  double duration = 0.0;  ///< by the clock (s)
  struct Joint {
    double position = 0.0;         ///< rad
    double velocity = 0.0;         ///< rad/s, as reported
    double torque = 0.0;           ///< N·m
    double position_change = 0.0;  ///< rad, over the window; half turns count the short way
    double kp = 0.0;               ///< position gain of the target (N·m/rad)
    /// By the servo's law (N·m): of the target as it is, negated, the other leg's, in degrees.
    std::array<double, 4> law = {};
  };
  std::array<Joint, models::servo_count> joint = {};
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< as reported, IMU frame (rad/s)
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();  ///< by the orientation, IMU frame (rad/s)
  Eigen::Vector3d linear_acceleration = Eigen::Vector3d::Zero();  ///< m/s²
  Eigen::Vector3d proper_acceleration = Eigen::Vector3d::Zero();  ///< m/s²
  Eigen::Vector3d up = Eigen::Vector3d::Zero();  ///< by the orientation, in the IMU frame
};

/// Collects records to windows. A gap in time, or a step back, drops the window that it interrupts.
class WindowCollector {
 public:
  /// `period`: between two records (s).
  explicit WindowCollector(double period);

  /// Adds a record. Returns the window that it completes, if any.
  std::optional<CheckedWindow> add(const models::Observation& record, const ServoTargets& targets);

 private:
  CheckedWindow finish(const models::Observation& record) const;

  double period_;
  std::size_t length_;
  std::size_t count_ = 0;
  CheckedWindow sum_;
  models::Observation first_;
  models::Observation previous_;
};

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
  /// Returns the record with NaN in place of every value beyond its bound.
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
  void report(Findings& findings) const;
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
                             Findings& findings);
  void report_joint(std::size_t servo, Findings& findings) const;
  static void report_vector(const char* name, const std::array<Channel, 3>& axes,
                            Findings& findings);

  std::array<std::array<Channel, 3>, models::servo_count> joints_;  ///< position, velocity, torque
  std::array<Channel, 4> orientation_;
  std::array<Channel, 3> angular_velocity_;
  std::array<Channel, 3> linear_acceleration_;
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
  double since_ = 0.0;                                ///< the orientation repeats itself (s)
  double time_ = 0.0;                                 ///< of the last record (s)
  Eigen::Vector3d turned_ = Eigen::Vector3d::Zero();  ///< by the gyroscope since then (rad)
};

/// Checks every joint that moves: its reported velocity is the derivative of its position. Units,
/// signs, and the order of joints show.
class JointMotionCheck {
 public:
  void add(const CheckedWindow& window);
  void report(Findings& findings) const;

 private:
  using Matrix = Eigen::Matrix<double, models::servo_count, models::servo_count>;
  using Vector = Eigen::Matrix<double, models::servo_count, 1>;

  int windows_ = 0;
  Matrix products_ = Matrix::Zero();  ///< Σ velocity i · derivative of position j
  Vector velocity_squares_ = Vector::Zero();
  Vector derivative_squares_ = Vector::Zero();
};

/// Checks the targets of hips and knees: by the servo's law, they give the measured torques.
class ServoLawCheck {
 public:
  void add(const CheckedWindow& window);
  void report(Findings& findings) const;

 private:
  struct Joint {
    int windows = 0;
    std::array<int, 4> apart = {};  ///< windows in which the torques differ, as `CheckedWindow`
    /// Of the law's torque, the measured one, and that of the same leg's knee or hip.
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();

    Eigen::Matrix3d spread() const;
  };
  std::array<Joint, models::servo_count> joints_ = {};
};

/// The angular velocity of a gyroscope and that of the orientation, compared in windows in which
/// the robot turns.
struct TurningComparison {
  int windows = 0;
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();  ///< Σ gyroscope · orientation's rateᵀ
  double gyroscope_squares = 0.0;
  double orientation_squares = 0.0;

  void add(const Eigen::Vector3d& gyroscope, const Eigen::Vector3d& orientation, double least);
};

/// Checks the gyroscope against the orientation of a robot that turns: both have the same angular
/// velocity in the IMU's frame. Units, signs, axes and the order of the quaternion show.
class TurningCheck {
 public:
  void add(const CheckedWindow& window);
  void report(Findings& findings) const;

 private:
  TurningComparison fast_;  ///< of windows
  TurningComparison slow_;  ///< of half seconds
  int count_ = 0;           ///< windows of the present half second
  Eigen::Vector3d gyroscope_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d orientation_ = Eigen::Vector3d::Zero();
};

/// Checks a robot that drives: both wheels roll the same way unless it turns, and it accelerates as
/// its wheels do. The right leg is the mirror image of the left one, which no torque shows: the
/// wheels show it.
class DrivingCheck {
 public:
  void add(const CheckedWindow& window);
  /// `has_acceleration`: the linear acceleration is free of gravity.
  void report(Findings& findings, bool has_acceleration) const;
  /// Whether the wheels drive the robot: they are on the ground.
  bool drives() const;

 private:
  /// Half a second between the first and the last one.
  static constexpr std::size_t length = 6;

  /// How well the acceleration along an axis of the IMU follows that of the wheels.
  struct Fit {
    double correlation = 0.0;
    double radius = 0.0;  ///< acceleration by that of the wheels (m)
  };

  bool turns_apart() const;
  Fit fit(int axis) const;
  void add_acceleration();

  int straight_ = 0;      ///< windows in which the wheels roll and the robot does not turn
  double same_ = 0.0;     ///< Σ of the wheels' common speed squared
  double opposed_ = 0.0;  ///< Σ of their difference squared
  std::array<CheckedWindow, length> last_;
  std::size_t count_ = 0;
  int accelerations_ = 0;
  double wheel_sum_ = 0.0;
  double wheel_squares_ = 0.0;
  Eigen::Vector3d imu_sum_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d imu_squares_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d products_ = Eigen::Vector3d::Zero();
};

/// Finds stretches of half a second in which the robot neither turns nor moves its legs: it stands,
/// or hangs. Such a robot accelerates little on average, so that its accelerometer shows gravity
/// alone, and its legs carry its weight, or nothing.
class StillStretches {
 public:
  /// Adds the next window. Returns the means over a stretch that it completes, if any.
  std::optional<CheckedWindow> add(const CheckedWindow& window);

 private:
  CheckedWindow sum_;
  int count_ = 0;
};

/// Checks the accelerometer while the robot is still: the linear acceleration is near 0, the proper
/// one is 9.8 m/s² along the upward vertical of the orientation.
class GravityCheck {
 public:
  /// Adds a stretch in which the robot is still (`StillStretches`).
  void add_still(const CheckedWindow& stretch);
  void report(Findings& findings) const;

 private:
  void report_linear(Findings& findings) const;
  void report_proper(Findings& findings) const;

  int stretches_ = 0;
  Eigen::Vector3d linear_ = Eigen::Vector3d::Zero();  ///< sum, along the axes of the IMU
  Eigen::Vector3d up_ = Eigen::Vector3d::Zero();      ///< sum
  int proper_stretches_ = 0;
  Eigen::Vector3d proper_ = Eigen::Vector3d::Zero();     ///< sum
  Eigen::Vector3d proper_up_ = Eigen::Vector3d::Zero();  ///< sum, of the same stretches
};

/// Checks the torques of hips and knees while the robot is still. Then the ground pushes each wheel
/// upwards with a force between 0 (it hangs) and the robot's weight, and not forwards. If the
/// torques of a log do not show such forces, but would with another sign, unit or order, that is
/// the likely cause.
class LoadCheck {
 public:
  /// `is_known`: `geometry` is that of the log's robot, and not an assumption.
  LoadCheck(const LegGeometry& geometry, bool is_known)
      : geometry_(geometry), is_known_(is_known) {}

  /// Adds a stretch in which the robot is still (`StillStretches`).
  void add_still(const CheckedWindow& stretch);
  /// Adds any window: the torques of a whole log have a least size.
  void add(const CheckedWindow& window);
  /// `drives`: the wheels drive the robot, so that its legs carry it.
  void report(Findings& findings, bool drives) const;

 private:
  static constexpr std::size_t hypotheses = 9;

  double torque_factor() const;
  std::string scale_text() const;
  bool report_misfit(Findings& findings) const;
  void report_small_load(Findings& findings, bool drives) const;
  void report_small_torques(Findings& findings) const;
  void report_pose(Findings& findings) const;

  LegGeometry geometry_;
  bool is_known_;
  int stretches_ = 0;                           ///< in which the load can be observed
  std::array<double, hypotheses> misfit_ = {};  ///< sums (N); the first is the log as it is
  double tolerance_ = 0.0;                      ///< sum (N)
  std::array<double, hypotheses> load_ = {};    ///< sums of both legs' (N)
  /// Sums of what the torques carry beside the legs' own weight, and would have to (N), each by
  /// the square of its error.
  double carried_ = 0.0;
  double to_carry_ = 0.0;
  double scaled_misfit_ = 0.0;  ///< sum (N), of the torques by a factor that gives the weight
  double largest_load_ = 0.0;   ///< of both legs in a stretch (N)
  int standing_stretches_ = 0;  ///< in which the torques carry the robot
  double axle_offset_ = 0.0;    ///< sum (m)
  int windows_ = 0;
  double largest_torque_ = 0.0;  ///< of hips and knees (N·m)
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
