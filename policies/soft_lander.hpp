#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "models/robot_model.hpp"
#include "policies/course.hpp"
#include "policies/policy.hpp"
#include "policies/wheel_contact.hpp"

namespace touchdown::policies {

/// Masses and lengths of a wheeled biped from the side, x forward, z up, for control laws. Both
/// legs count as one. All joints are at zero, where both links point straight down.
struct SideView {
  double torso_mass = 0.0;       ///< kg
  double upper_mass = 0.0;       ///< of both legs (kg)
  double lower_mass = 0.0;       ///< of both legs (kg)
  double mass = 0.0;             ///< of the whole robot, wheels included (kg)
  Eigen::Vector2d torso_centre;  ///< centre of mass from the hip (m)
  Eigen::Vector2d upper_centre;  ///< centre of mass from the hip (m)
  Eigen::Vector2d lower_centre;  ///< centre of mass from the knee (m)
  double upper_length = 0.0;     ///< hip to knee (m)
  double lower_length = 0.0;     ///< knee to axle (m)
  /// Sign that makes hip and knee angles positive forward: left, right.
  std::array<double, 2> forward = {1.0, -1.0};

  /// Vector (m) from the axle to the centre of mass of the robot without wheels. The angles of
  /// hips, knees and torso are positive forward (rad).
  Eigen::Vector2d centre(double hip, double knee, double pitch) const;
};

SideView side_view(const models::RobotModel& robot);

/// A balancer that uses contact. It differs from `WheelBalancer` in three ways:
/// - It balances the centre of mass, not the torso.
/// - In the air it keeps the ground speed on its wheels.
/// - It softens its knees for a landing, each leg along its own line. It also does so when one
///   wheel hangs over an edge, and sinks instead of tipping over the other wheel.
/// Wheel commands and gains are those of policies/wheel_balancer.hpp. Equations and the effect of
/// each part: docs/explanation/policy.md.
class SoftLander : public Policy {
 public:
  SoftLander(const WheelBalancerConfig& config, Course course, const SideView& robot,
             WheelContact contact);

  void reset(const models::Observation& observation) override;
  models::Action act(const models::Observation& observation) override;

  /// Softness of the legs: 0 is as stiff as on the ground, 1 is softest.
  double softness() const { return softness_; }

 private:
  /// Whether both wheels have been without contact for longer than a false alarm.
  bool is_flying() const;
  void update_ground_velocity(const models::Observation& observation);
  void update_softness();
  void command_leg(std::size_t side, const models::Observation& observation,
                   models::Action& action) const;

  WheelBalancerConfig config_;
  Course course_;
  SideView robot_;
  WheelContact contact_source_;

  std::array<bool, models::wheel_count> contact_ = {true, true};
  double held_velocity_ = 0.0;    ///< ground speed during the last contact (m/s)
  double integral_ = 0.0;         ///< m/s
  double ground_velocity_ = 0.0;  ///< commanded to the wheels (m/s)
  double in_air_ = 0.0;           ///< time since both wheels lost contact (s)
  double one_in_air_ = 0.0;       ///< time since either wheel lost contact (s)
  double standing_ = 0.0;         ///< time since the first contact after a flight (s)
  double on_ground_ = 0.0;        ///< time since both regained contact, bumps ignored (s)
  double softness_ = 0.0;
  std::optional<models::Action> previous_;  ///< the last action
};

}  // namespace touchdown::policies
