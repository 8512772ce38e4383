#pragma once

// load_logistic.npz, written by `touchdown export`: fitted for 'load_logistic' at 1000 Hz to the
// robot 'upkie', fingerprint d1b191497ff374b0.
// touchdown::make_estimator(touchdown::compiled::model) makes the estimator.

// clang-format off
#include <touchdown/estimator.hpp>

namespace touchdown::compiled {

inline constexpr char model_estimator[] =
"load_logistic";
inline constexpr double model_intercept[] = {
-4.0038664058454465,};
inline constexpr char model_metadata[] =
"format: 1\n"
"estimator: load_logistic\n"
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
"configuration.largest_force: 200\n"
"configuration.low_pass: 0.01\n"
"configuration.threshold: 0.5\n"
"fingerprint: d1b191497ff374b0\n"
"";
inline constexpr char model_provenance[] =
"estimator: load_logistic\n"
"scenarios: stairs\n"
"seconds: 13.470\n"
"seed:run: 1:1\n"
"simulators: mujoco\n"
"";
inline constexpr double model_slope[] = {
0.542866830437614,};

inline constexpr CompiledArray model[] = {
    {"estimator", 13, 0, nullptr, nullptr, model_estimator},
    {"intercept", 1, 0, model_intercept, nullptr, nullptr},
    {"metadata", 699, 0, nullptr, nullptr, model_metadata},
    {"provenance", 92, 0, nullptr, nullptr, model_provenance},
    {"slope", 1, 0, model_slope, nullptr, nullptr},
};

}  // namespace touchdown::compiled
