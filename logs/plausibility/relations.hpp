#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "logs/plausibility/findings.hpp"
#include "logs/plausibility/window.hpp"

namespace touchdown::logs {

/// A vector that is measured, and the same by other signals: sums over windows. Another order or
/// sign of its axes, or a factor, with which it fits better is the cause to name.
class Relation {
 public:
  /// `least`: of the larger of both vectors in windows that count, 0 = all; in the vectors' unit.
  explicit Relation(int size, double least = 0.0);

  /// Leaves out windows that lack a value.
  void add(const Eigen::VectorXd& measured, const Eigen::VectorXd& predicted);

  int windows() const { return windows_; }
  /// Root mean squares.
  double measured(int axis) const;
  double predicted(int axis) const;
  /// About zero, −1 to 1; 0 without motion.
  double correlation(int measured, int predicted) const;
  /// The same about the means.
  double covariation(int measured, int predicted) const;
  /// Spread of a measured axis by that of the prediction.
  double slope(int measured, int predicted) const;
  /// Standard deviations, of a measured axis and of its difference from a predicted one.
  double deviation(int measured) const;
  double difference(int measured, int predicted) const;
  Eigen::VectorXd measured_mean() const { return measured_ / windows_; }
  Eigen::VectorXd predicted_mean() const { return predicted_ / windows_; }
  /// The measured vector by the predicted one.
  double factor() const;
  /// −1 to 1: how well the whole vectors agree.
  double agreement() const;

  /// Axes of the measured vector, by those of the prediction, with their signs.
  struct Axes {
    std::vector<int> order;
    std::vector<double> sign;
    double fit = 0.0;  ///< as `agreement`
  };
  /// The signed permutation that fits best.
  Axes best() const;

 private:
  double spread(int measured, int predicted) const;

  double least_;
  int windows_ = 0;
  Eigen::MatrixXd products_;  ///< Σ measured · predictedᵀ
  Eigen::VectorXd measured_, predicted_, measured_squares_, predicted_squares_;
};

/// The cause of a factor between a measured quantity and its prediction, by one table of units.
/// `quantity`: "angle" (positions), "rate", "turn", "acceleration", "torque". `error`: of the
/// factor's logarithm. Returns `otherwise` for a factor of no unit.
std::string cause_of(const char* quantity, double factor, double error, const char* otherwise);

/// All vectors of a log that other signals predict, but the torques of hips and knees
/// (`LoadRelation`): velocities by positions, angular velocity by the orientation, acceleration by
/// gravity and by the wheels, the right wheel by the left one, torques by the servos' targets.
class Relations {
 public:
  explicit Relations(const QuaternionReading& reading);

  void add(const CheckedWindow& window);
  /// Adds a stretch in which the robot is still (`StillStretches`).
  void add_still(const CheckedWindow& stretch);
  /// `measures_acceleration`: the accelerometer is not dead.
  void report(Findings& findings, bool measures_acceleration = true) const;
  /// Whether the wheels drive the robot: they are on the ground.
  bool drives() const;
  /// Whether the orientation has the robot upright on average.
  bool is_upright() const { return !is_other_order() && up_.z() < -0.5 * oriented_; }

 private:
  /// The gyroscope by the orientation.
  struct Turning {
    Turning();
    const Relation& relation() const { return is_fast() ? windows : half_seconds; }
    bool is_fast() const;
    bool is_known() const;

    Relation windows;
    Relation half_seconds;  ///< for a robot that turns slowly; they overlap
  };

  /// Returns whether those of the wheels are the derivatives of their positions.
  bool report_velocities(Findings& findings) const;
  void report_targets(Findings& findings) const;
  void report_turning(Findings& findings) const;
  bool report_gravity(Findings& findings, bool measures_acceleration) const;
  void report_driving(Findings& findings, bool has_acceleration, bool has_velocities) const;
  bool is_other_order() const;
  void add_driving(const CheckedWindow& window);
  bool wheels_oppose() const;

  Relation velocity_;
  Relation exchanged_;  ///< positions by the change of velocities
  Turning turning_;
  Turning other_turning_;  ///< if the quaternion's numbers are in the other order
  Relation wheels_;        ///< the right one by the left one, while the robot drives straight
  Relation acceleration_;  ///< of the IMU by that of the wheels
  Relation proper_;        ///< by gravity
  Relation linear_;        ///< by gravity: it holds none
  std::vector<Relation> targets_;  ///< by joint: hip and knee by the law
  std::array<std::array<int, 4>, models::servo_count> apart_ = {};
  std::vector<CheckedWindow> last_;               ///< half a second
  Eigen::Vector3d up_ = Eigen::Vector3d::Zero();  ///< sum
  QuaternionReading reading_;
  int oriented_ = 0;  ///< windows of it
};

}  // namespace touchdown::logs
