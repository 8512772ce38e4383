#pragma once

#include <cstdint>
#include <ostream>

#include "logs/log/reader.hpp"
#include "logs/recording.hpp"
#include "models/robot_model.hpp"

namespace touchdown::render {

inline constexpr const char* mcap_scene_topic = "/touchdown/scene";
inline constexpr const char* mcap_transforms_topic = "/touchdown/transforms";
inline constexpr const char* mcap_events_topic = "/touchdown/events";

/// Writes a log as an MCAP file (`logs::write_mcap`) with what Foxglove's 3-D panel shows
/// without a plug-in: robot and terrain once, poses of the robot's bodies 50 times a second, and
/// true takeoffs, landings and the end of a simulated run as log messages. `recording` is the same
/// log in memory. Returns the number of rows. Errors: those of `write_mcap`.
std::uint64_t write_mcap_with_scene(logs::LogReader& reader, std::ostream& stream,
                                    const models::RobotModel& robot,
                                    const logs::Recording& recording);

}  // namespace touchdown::render
