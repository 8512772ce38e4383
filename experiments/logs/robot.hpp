#pragma once

#include <optional>
#include <string>

#include "estimator/force/leg_geometry.hpp"
#include "logs/plausibility/channels.hpp"
#include "logs/recording.hpp"

namespace touchdown::experiments {

/// The robot of some logs.
struct LogRobot {
  std::string name = {};                         ///< empty: as in the logs, if they name one
  std::optional<LegGeometry> legs = {};          ///< from its file, if there is one
  std::optional<logs::JointRanges> ranges = {};  ///< of its joints, likewise
};

/// Takes a name, or a file: an MJCF, or a YAML description of one (models/robot_description.hpp). A
/// file gives the robot its name and its legs. Errors: `InputError` for a missing file (with the
/// nearest name in its folder) and for a file that describes no robot.
LogRobot robot_called(const std::string& name_or_file);

/// The same where a name alone would have no effect; empty text gives no robot. Errors: also
/// `InputError` for a name.
LogRobot robot_of_file(const std::string& file);

/// What the checks of a log know about its robot: the requested one, else the one that a simulated
/// log names. There is a doubt if that robot's files cannot be read, or were changed since the
/// recording.
logs::CheckedRobot checked_robot(const LogRobot& requested, const logs::RecordingInfo& log);

/// Errors: `InputError` for a recording, called `name`, of a robot that is not the same any more. A
/// recording of an older program has no digest, and its robot counts as the same.
void require_recorded_robot(const logs::RecordingInfo& recording, const std::string& name);

/// A model's robot for messages: its name in quotes, or "an unnamed robot".
std::string robot_text(const std::string& name);

}  // namespace touchdown::experiments
