#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "render/film/request.hpp"

namespace touchdown::render {

/// Only this much of a longer run is replayed (s), because the page contains it.
inline constexpr double longest_replay = 60.0;

/// Poses per second, and beliefs per second.
inline constexpr double replay_pose_rate = 50.0;
inline constexpr double replay_belief_rate = 100.0;

/// What the report's replay draws of simulated runs, for `replay.js`:
///
/// - `scenes`: robots on their terrains, each once. A scene has `bodies`, of which the first is the
///   terrain; each is a list of `[shape, x, y, z, qw, qx, qy, qz, width, depth, height, r, g, b,
///   mesh]` (m), and `meshes`.
/// - `runs`: each with its scene and poses of all bodies but the terrain: position and quaternion,
///   in 16 bits. `truth` has bit 0 for the left wheel, bit 1 for the right. `beliefs` of each
///   estimator have a byte per step and wheel: twice P(contact) in 127ths, plus its
///   decision (without decisions, whether P(contact) is above ½).
nlohmann::ordered_json replay_data(const std::vector<VideoSource>& runs,
                                   const scoring::LabelConfig& labels);

}  // namespace touchdown::render
