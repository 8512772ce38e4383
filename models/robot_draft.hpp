#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "models/mjcf/types.hpp"
#include "models/robot.hpp"

namespace touchdown::models {

/// A line of a robot's YAML file.
struct DraftLine {
  std::string key;
  std::string value;    ///< as YAML; empty: the line is a comment alone
  std::string comment;  ///< what was guessed, and from what; empty if nothing was
};

/// A hinge that may be a wheel's.
struct Axle {
  int joint = -1;
  double radius = 0.0;   ///< of its largest round body (m); 0 without one
  std::string tyre;      ///< the geom or body to name; empty if only a radius serves
  bool is_mesh = false;  ///< whether the round body is a mesh
};

/// The legs of a robot with any names of its parts.
struct FoundLegs {
  std::array<Axle, wheel_count> axle;  ///< left, right
  /// The hinges parallel to the axles, hip and knee or the knee alone.
  std::array<std::vector<int>, wheel_count> pitch;
  bool has_sides = false;  ///< whether names distinguish left from right
};

/// Finds the legs in a model's pose. Assumptions:
/// - Wheels are the two like hinges side by side, with one axis, that move no other joint; of
///   several pairs the lowest with round bodies, without limits, or called wheels.
/// - Hip and knee are the hinges parallel to the wheels' axis between base and wheel; of more than
///   two, those that divide the leg most evenly.
/// - Left is what names have with an l where the other side has an r, else the larger y.
/// Errors: `InputError` where no two wheels, or no knees, are found.
FoundLegs find_legs(const mjModel& model, const mjData& data, int base);

/// The joints of both legs, from the first one down to the wheel's.
using JointsOfLegs = std::array<std::vector<int>, wheel_count>;

/// Whether a joint is one of a loop that the file cuts open. It moves no wheel and turns about an
/// axis parallel to the axles. It is on a leg, or its chain on the base ends beside a link of one.
bool is_rod(const mjModel& model, const mjData& data, const JointsOfLegs& legs, int joint);

/// Whether a text has a part, in capitals or not. The part is in small letters.
bool has_part(std::string_view text, std::string_view part);

inline constexpr double parallel = 0.97;  ///< least cosine of axes that count as one: 14°

/// A name as YAML, also within brackets.
std::string as_yaml(const std::string& name);

/// Drafts the YAML file about a robot from its MJCF or URDF, whatever its parts are called:
/// `joints`, `held`, `tyres`, `imu`, `actuators`, `balancer`. Joints that are no servo's are held,
/// but for those in loops and for rods of a cut loop. Errors: `InputError` for a file that no
/// YAML file can help; those of `find_legs`.
std::vector<DraftLine> drafted_robot(const std::filesystem::path& robot);

/// The file's text. `robot` is the MJCF or URDF as the YAML file names it.
std::string text_of(const std::vector<DraftLine>& draft, const std::string& robot);

}  // namespace touchdown::models
