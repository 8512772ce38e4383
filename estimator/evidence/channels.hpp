#pragma once

#include <array>
#include <cmath>

#include "estimator/decision/feature_extractor.hpp"

namespace touchdown {

/// Name and unit of a channel of `DecisionInputs`.
struct EvidenceChannel {
  const char* name;      ///< in files
  const char* title;     ///< in figures
  const char* unit;      ///< before compression
  float softsign_scale;  ///< of the compression, in that unit
};

/// In the order of `DecisionInputs`. Each channel has `decision_scales` inputs, the fastest first.
inline constexpr std::array<EvidenceChannel, decision_channels> evidence_channels = {{
    {"load", "load", "N", leg_softsign_scales[0]},
    {"reaction", "ground torque", "N·m", leg_softsign_scales[1]},
    {"axle_velocity", "axle velocity", "m/s", leg_softsign_scales[2]},
    {"axle_acceleration", "axle acceleration", "m/s²", leg_softsign_scales[3]},
    {"other_load", "other wheel's load", "N", leg_softsign_scales[0]},
    {"other_reaction", "other wheel's ground torque", "N·m", leg_softsign_scales[1]},
    {"other_axle_velocity", "other axle's velocity", "m/s", leg_softsign_scales[2]},
    {"other_axle_acceleration", "other axle's acceleration", "m/s²", leg_softsign_scales[3]},
    {"vertical_acceleration", "vertical acceleration", "m/s²", acceleration_softsign_scale},
    {"roll_rate", "roll rate, own side down", "rad/s", roll_rate_softsign_scale},
}};

/// In the order of `ServoLoadInputs`, which a model may lack.
inline constexpr std::array<EvidenceChannel, 2> servo_load_channels = {{
    {"servo_load", "load by the servo law", "N", leg_softsign_scales[0]},
    {"other_servo_load", "other wheel's load by the servo law", "N", leg_softsign_scales[0]},
}};

/// The last two of `DecisionInputs`: logarithms of the estimated white noise levels (N·m, m/s²).
inline constexpr std::array<const char*, 2> evidence_noise_names = {"torque_noise",
                                                                    "acceleration_noise"};

/// The softsign compression of `FeatureExtractor`, for a channel with this scale, …
[[nodiscard]] inline double compressed(double value, double scale) noexcept {
  return value / scale / (1.0 + std::abs(value / scale) / static_cast<double>(saturation));
}
/// … and its inverse, for magnitudes below `saturation`.
[[nodiscard]] inline double uncompressed(double input, double scale) noexcept {
  return scale * input / (1.0 - std::abs(input) / static_cast<double>(saturation));
}

}  // namespace touchdown
