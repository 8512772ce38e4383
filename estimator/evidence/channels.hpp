#pragma once

#include <array>
#include <cmath>

#include "estimator/decision/feature_extractor.hpp"

namespace touchdown {

/// What a person calls a channel of `DecisionInputs`.
struct EvidenceChannel {
  const char* name;   ///< in files
  const char* title;  ///< for people
  const char* unit;   ///< of what is heard, before it is compressed
  float bend;         ///< of its compression, in that unit
};

/// In the order of `DecisionInputs`: each has `decision_scales` of them, the fastest first.
inline constexpr std::array<EvidenceChannel, decision_channels> evidence_channels = {{
    {"load", "its load", "N", leg_softsign_scales[0]},
    {"reaction", "the ground's torque on it", "N·m", leg_softsign_scales[1]},
    {"axle_velocity", "its axle's velocity", "m/s", leg_softsign_scales[2]},
    {"axle_acceleration", "its axle's acceleration", "m/s²", leg_softsign_scales[3]},
    {"other_load", "the other wheel's load", "N", leg_softsign_scales[0]},
    {"other_reaction", "the ground's torque on the other", "N·m", leg_softsign_scales[1]},
    {"other_axle_velocity", "the other axle's velocity", "m/s", leg_softsign_scales[2]},
    {"other_axle_acceleration", "the other axle's acceleration", "m/s²", leg_softsign_scales[3]},
    {"vertical_acceleration", "vertical acceleration", "m/s²", acceleration_softsign_scale},
    {"roll_rate", "roll rate, its side down", "rad/s", roll_rate_softsign_scale},
}};

/// The last two of `DecisionInputs`, logarithms of white noise's estimated levels: N·m, m/s².
inline constexpr std::array<const char*, 2> evidence_noise_names = {"torque_noise",
                                                                    "acceleration_noise"};

/// As `FeatureExtractor` compress a channel that bends there, …
[[nodiscard]] inline double compressed(double value, double bend) noexcept {
  return value / bend / (1.0 + std::abs(value / bend) / static_cast<double>(saturation));
}
/// … and back, for less than `saturation`.
[[nodiscard]] inline double uncompressed(double heard, double bend) noexcept {
  return bend * heard / (1.0 - std::abs(heard) / static_cast<double>(saturation));
}

}  // namespace touchdown
