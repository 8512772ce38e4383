#include <string>

#include "core/error.hpp"
#include "core/fields.hpp"
#include "models/robot_description.hpp"
#include "tests/fuzz/entry.hpp"

namespace touchdown::fuzz {

/// A robot file, without the MJCF that it names.
TOUCHDOWN_FUZZ(yaml_robot) {
  try {
    (void)from_yaml<models::RobotDescription>(YamlDocument::parse(std::string(input), "fuzz.yaml"));
  } catch (const Error& error) {
    expected(error, input);
  }
}

}  // namespace touchdown::fuzz
