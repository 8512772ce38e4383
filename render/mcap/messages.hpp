#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include <mujoco/mujoco.h>

namespace touchdown::render {

/// A message of a Foxglove schema, as JSON.
using McapJson = nlohmann::ordered_json;

/// A time (ns) as seconds and nanoseconds.
McapJson mcap_time(std::uint64_t time);

/// foxglove.SceneUpdate: everything that films draw of the robot and its terrain. Each body is an
/// entity in a frame of its own, named as the body; the terrain is in the frame "world". Meshes
/// become triangles, a plane a thin box, a capsule a cylinder with two spheres.
McapJson scene_update(const mjModel& model, std::uint64_t time);

/// foxglove.FrameTransforms: the pose of each body in the frame "world". `data` holds the poses.
McapJson frame_transforms(const mjModel& model, const mjData& data, std::uint64_t time);

/// foxglove.Log: an event. `level`: 2 for information, 3 for a warning.
McapJson log_message(const std::string& name, const std::string& message, int level,
                     std::uint64_t time);

}  // namespace touchdown::render
