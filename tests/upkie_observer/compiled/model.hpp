#pragma once

// load_filter.npz, written by `touchdown convert`: for 'load_filter' at 1000 Hz on the robot
// 'upkie', fingerprint 33de8d0425eda169. touchdown::make_estimator(touchdown::compiled::model)
// makes the estimator.

// clang-format off
#include <touchdown/estimator.hpp>

namespace touchdown::compiled {

inline constexpr char model_estimator[] =
"load_filter";
inline constexpr char model_metadata[] =
"format: 1\n"
"estimator: load_filter\n"
"sample_rate: 1000\n"
"robot: upkie\n"
"units: SI\n"
"configuration.geometry.hip_armature: 0\n"
"configuration.geometry.hip_forward: 0\n"
"configuration.geometry.hip_torque_limit: 16\n"
"configuration.geometry.hip_upward: -0.064\n"
"configuration.geometry.hip_viscous: 0\n"
"configuration.geometry.knee_armature: 0\n"
"configuration.geometry.knee_torque_limit: 16\n"
"configuration.geometry.knee_viscous: 0\n"
"configuration.geometry.leg_sideways: 0.186481\n"
"configuration.geometry.lower_centre: 0.742\n"
"configuration.geometry.lower_inertia: 0.00212266\n"
"configuration.geometry.lower_length: 0.175\n"
"configuration.geometry.lower_mass: 0.3954\n"
"configuration.geometry.upper_centre: 0.855\n"
"configuration.geometry.upper_inertia: 0.00280122\n"
"configuration.geometry.upper_length: 0.168\n"
"configuration.geometry.upper_mass: 0.69241\n"
"configuration.geometry.wheel_armature: 0\n"
"configuration.geometry.wheel_mass: 0.18455\n"
"configuration.geometry.wheel_torque_limit: 1.7\n"
"configuration.geometry.wheel_viscous: 0\n"
"configuration.guard.frozen_after: 0.5\n"
"configuration.guard.largest_acceleration: 10000\n"
"configuration.guard.largest_torque: 10000\n"
"configuration.guard.maximum_gap: 0.02\n"
"configuration.guard.relaxation: 0.1\n"
"configuration.hip_friction: 0\n"
"configuration.knee_friction: 0\n"
"configuration.lead: 0.005\n"
"configuration.leave_below: 0.1\n"
"configuration.return_above: 0.95\n"
"configuration.robot_mass: 5.33922\n"
"configuration.wheel_inertia: 0.00017456\n"
"fingerprint: 33de8d0425eda169\n"
"";

inline constexpr CompiledArray model[] = {
    {"estimator", 11, 0, nullptr, nullptr, model_estimator},
    {"metadata", 1428, 0, nullptr, nullptr, model_metadata},
};

}  // namespace touchdown::compiled
