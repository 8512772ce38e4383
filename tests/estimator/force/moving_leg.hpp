#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include "estimator/force/leg_geometry.hpp"
#include "estimator/signals.hpp"
#include "tests/estimator/force/held_leg.hpp"

namespace touchdown::test {

/// A robot in its plane at a time (s): the IMU's place (m, forward and up), the torso's pitch
/// (rad, positive leans forward), and the left leg's joints (rad). Legs move alike.
struct PlanarPose {
  double x = 0.0;
  double z = 0.0;
  double pitch = 0.0;
  double hip = 0.455;
  double knee = -0.791;
  double wheel = 0.0;
};
using PlanarMotion = std::function<PlanarPose(double time)>;

/// Friction and rotors are at the joints; everything else of the motion is a function of time,
/// which differences turn into velocities, accelerations and virtual displacements.
class MovingLeg {
 public:
  MovingLeg(const LegGeometry& geometry, PlanarMotion motion)
      : geometry_(geometry), motion_(std::move(motion)) {}

  /// What a robot without lateral motion reports, with this force on each axle (N, forward and up)
  /// and the wheel's torque that it needs with the given moment on the wheel (N·m).
  Signals at(double time, double forward, double upward, double moment = 0.0) const {
    Signals signals;
    signals.time = time;
    const PlanarPose pose = motion_(time);
    const Eigen::Vector2d acceleration =
        second([&](double t) { return imu(motion_(t)); }, time);  // world, forward and up
    const double s = std::sin(pose.pitch);
    const double c = std::cos(pose.pitch);
    // Leaning forward turns the torso's x axis down.
    signals.linear_acceleration = {-(c * acceleration.x() - s * acceleration.y()), 0.0,
                                   -(s * acceleration.x() + c * acceleration.y())};
    signals.vertical_acceleration = acceleration.y();
    signals.up = {s, 0.0, -c};
    signals.angular_velocity = {0.0, first([&](double t) { return motion_(t).pitch; }, time), 0.0};
    const std::array<double, 3> torque = torques(time, {forward, upward}, moment);
    LegSignals& leg = signals.leg[0];
    const std::array<JointSignals*, 3> joints = {&leg.hip, &leg.knee, &leg.wheel};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto angle = [&](double t) { return joint(motion_(t), i); };
      *joints[i] = {angle(time), first(angle, time), torque[i]};
    }
    signals.leg[1] = mirrored(leg);
    return signals;
  }

 private:
  struct Body {
    double mass;
    double inertia;
    Eigen::Vector2d place;
    double angle;  ///< about the axis to the right
  };

  static double joint(const PlanarPose& pose, std::size_t i) {
    return i == 0 ? pose.hip : i == 1 ? pose.knee : pose.wheel;
  }
  static double& joint(PlanarPose& pose, std::size_t i) {
    return i == 0 ? pose.hip : i == 1 ? pose.knee : pose.wheel;
  }
  static Eigen::Vector2d imu(const PlanarPose& pose) { return {pose.x, pose.z}; }
  static double first(const std::function<double(double)>& f, double t) {
    constexpr double h = 1e-4;
    return (f(t + h) - f(t - h)) / (2.0 * h);
  }
  template <typename F>
  static std::invoke_result_t<F, double> second(const F& f, double t) {
    constexpr double h = 1e-3;
    const auto plus = f(t + h);
    const auto minus = f(t - h);
    const auto middle = f(t);
    return (plus - 2.0 * middle + minus) / (h * h);
  }

  /// Upper link, lower link, wheel.
  std::array<Body, 3> bodies(const PlanarPose& pose) const {
    const LegGeometry& g = geometry_;
    const auto along = [](double angle, double length) {
      return Eigen::Vector2d(length * std::sin(angle), -length * std::cos(angle));
    };
    const double s = std::sin(pose.pitch);
    const double c = std::cos(pose.pitch);
    const Eigen::Vector2d hip = imu(pose) + Eigen::Vector2d(c * g.hip_forward + s * g.hip_upward,
                                                            -s * g.hip_forward + c * g.hip_upward);
    const double upper = pose.hip - pose.pitch;
    const double lower = upper + pose.knee;
    const Eigen::Vector2d knee = hip + along(upper, g.upper_length);
    return {{{g.upper_mass, g.upper_inertia, hip + along(upper, g.upper_centre * g.upper_length),
              upper},
             {g.lower_mass, g.lower_inertia, knee + along(lower, g.lower_centre * g.lower_length),
              lower},
             {g.wheel_mass, g.wheel_inertia - g.wheel_armature, knee + along(lower, g.lower_length),
              lower - pose.wheel}}};
  }

  /// By the principle of d'Alembert: the virtual work of all forces vanishes.
  std::array<double, 3> torques(double time, const Eigen::Vector2d& force, double moment) const {
    constexpr double h = 1e-6;
    const PlanarPose pose = motion_(time);
    const std::array<double, 3> armature = {geometry_.hip_armature, geometry_.knee_armature,
                                            geometry_.wheel_armature};
    const std::array<double, 3> viscous = {geometry_.hip_viscous, geometry_.knee_viscous,
                                           geometry_.wheel_viscous};
    std::array<double, 3> torque{};
    for (std::size_t i = 0; i < 3; ++i) {
      PlanarPose up = pose;
      PlanarPose down = pose;
      joint(up, i) += h;
      joint(down, i) -= h;
      const std::array<Body, 3> above = bodies(up);
      const std::array<Body, 3> below = bodies(down);
      double work =
          force.dot(above[2].place - below[2].place) + moment * (above[2].angle - below[2].angle);
      for (std::size_t body = 0; body < 3; ++body) {
        const auto place = [&](double t) { return bodies(motion_(t))[body].place; };
        const auto angle = [&](double t) { return bodies(motion_(t))[body].angle; };
        const Eigen::Vector2d pull =
            above[body].mass * (Eigen::Vector2d(0.0, -gravity) - second(place, time));
        work += pull.dot(above[body].place - below[body].place) -
                above[body].inertia * second(angle, time) * (above[body].angle - below[body].angle);
      }
      const auto turned = [&](double t) { return joint(motion_(t), i); };
      torque[i] =
          -work / (2.0 * h) + armature[i] * second(turned, time) + viscous[i] * first(turned, time);
    }
    return torque;
  }

  LegGeometry geometry_;
  PlanarMotion motion_;
};

}  // namespace touchdown::test
