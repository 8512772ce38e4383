#pragma once

#include <optional>
#include <string>

#include "estimator/force/leg_geometry.hpp"

namespace touchdown::experiments {

/// Whose logs they are.
struct LogRobot {
  std::string name = {};                 ///< empty: as the logs say, if they do
  std::optional<LegGeometry> legs = {};  ///< as its file has them, if there is one
};

/// From what somebody calls it: by a name, or by its file, an MJCF or a YAML file about one
/// (models/robot_description.hpp), of which it has its name and its legs. Errors: `InputError` for
/// a file that is not there, with the nearest name in its folder, or that describes no robot.
LogRobot robot_called(const std::string& name_or_file);

/// A model's robot as a message has it: its name in quotes, or that it has none.
std::string robot_text(const std::string& name);

}  // namespace touchdown::experiments
