#pragma once

#include <string>

#include <yaml-cpp/yaml.h>

namespace touchdown {

/// A value as YAML on one line, each number by the shortest text that reads back to it. A number
/// that is not finite is "none": such keys are not written.
std::string value_text(const YAML::Node& value);

/// "0 to 10", or "≥ 0" if the upper limit only excludes absurd numbers.
std::string range_text(double low, double high);

}  // namespace touchdown
