#pragma once

#include <string>
#include <vector>

#include "models/mjcf/parts.hpp"
#include "models/mjcf/robot_file.hpp"
#include "models/mjcf/types.hpp"
#include "models/robot_description.hpp"
#include "models/terrain.hpp"

namespace touchdown::models {

/// A robot's file with nothing but the robot in it.
struct RobotFile {
  MjcfDocument document;
  FileFindings findings;
  std::vector<LoopSites> loops;
};

/// Reads the file of a description, with its own names of parts. Errors: `InputError` for what is
/// no robot. What cannot be simulated is among the findings.
RobotFile robot_file(const RobotDescription& description, const RobotKeys& keys);

/// Compiles it with a terrain. Errors: those of `compile_xml`.
MjModelPtr compile(const RobotFile& robot, const Terrain& terrain);

}  // namespace touchdown::models
