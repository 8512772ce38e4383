#pragma once

// force_kinematics.npz, written by `touchdown export`: for 'force_kinematics' at 1000 Hz on the
// robot 'upkie', fingerprint 69c1eb1406a13bc6.
// touchdown::make_estimator(touchdown::compiled::model) makes the estimator.

// clang-format off
#include <touchdown/estimator.hpp>

namespace touchdown::compiled {

inline constexpr double model_axle_deviation[] = {
0.9916138194115276,0.21831087445105093,};
inline constexpr char model_estimator[] =
"force_kinematics";
inline constexpr double model_force_deviation[] = {
2.475912391035236,5.607221067065733,};
inline constexpr double model_force_mean[] = {
0.5940386604345701,25.851048111878967,};
inline constexpr double model_leaving_rate[] = {
5.252790544977406,0.6881720430105919,};
inline constexpr char model_metadata[] =
"format: 1\n"
"estimator: force_kinematics\n"
"sample_rate: 1000\n"
"robot: upkie\n"
"units: SI\n"
"configuration.geometry.lower_centre: 0.742\n"
"configuration.geometry.lower_length: 0.175\n"
"configuration.geometry.lower_mass: 0.3954\n"
"configuration.geometry.upper_centre: 0.855\n"
"configuration.geometry.upper_length: 0.168\n"
"configuration.geometry.upper_mass: 0.69241\n"
"configuration.geometry.wheel_mass: 0.18455\n"
"configuration.guard.frozen_after: 0.5\n"
"configuration.guard.largest_acceleration: 10000\n"
"configuration.guard.largest_torque: 10000\n"
"configuration.guard.maximum_gap: 0.02\n"
"configuration.guard.relaxation: 0.1\n"
"configuration.largest_force: 60\n"
"configuration.leak: 0.3\n"
"configuration.low_pass: 0.007\n"
"configuration.threshold: 0.5\n"
"fingerprint: 69c1eb1406a13bc6\n"
"";
inline constexpr char model_provenance[] =
"estimator: force_kinematics\n"
"scenarios: stairs\n"
"seconds: 13.148\n"
"seed:run: 1:0\n"
"simulators: mujoco\n"
"";

inline constexpr CompiledArray model[] = {
    {"axle_deviation", 2, 0, model_axle_deviation, nullptr, nullptr},
    {"estimator", 16, 0, nullptr, nullptr, model_estimator},
    {"force_deviation", 2, 0, model_force_deviation, nullptr, nullptr},
    {"force_mean", 2, 0, model_force_mean, nullptr, nullptr},
    {"leaving_rate", 2, 0, model_leaving_rate, nullptr, nullptr},
    {"metadata", 726, 0, nullptr, nullptr, model_metadata},
    {"provenance", 95, 0, nullptr, nullptr, model_provenance},
};

}  // namespace touchdown::compiled
