#include "noise/sensors/factor.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/fields.hpp"

namespace touchdown::noise {

namespace {

/// A disturbance that a study can vary, with the number that sets its size.
struct VariedDisturbance {
  const char* name;
  double& (*of)(SensorChannel& channel);
  bool has_no_unit;  ///< may be set for all sensors at once
  bool on_joints = true;
  bool on_attitude = true;
  bool is_shared_by_axes = false;
};
constexpr std::array disturbances = {
    VariedDisturbance{"scale", [](SensorChannel& c) -> double& { return c.scale.sd; }, true, true,
                      false},
    VariedDisturbance{"bias", [](SensorChannel& c) -> double& { return c.bias.sd; }, false},
    VariedDisturbance{"walk", [](SensorChannel& c) -> double& { return c.walk; }, false},
    VariedDisturbance{"vibration",
                      [](SensorChannel& c) -> double& { return c.vibration.amplitude; }, false,
                      false, false},
    VariedDisturbance{"coloured", [](SensorChannel& c) -> double& { return c.coloured.sd; }, false},
    VariedDisturbance{"low_pass", [](SensorChannel& c) -> double& { return c.low_pass; }, true,
                      true, false},
    VariedDisturbance{"white", [](SensorChannel& c) -> double& { return c.white; }, false},
    VariedDisturbance{"degrees_of_freedom",
                      [](SensorChannel& c) -> double& { return c.degrees_of_freedom; }, true},
    VariedDisturbance{"range", [](SensorChannel& c) -> double& { return c.range; }, false, true,
                      false},
    VariedDisturbance{"resolution", [](SensorChannel& c) -> double& { return c.resolution; }, false,
                      true, false},
    VariedDisturbance{"rate", [](SensorChannel& c) -> double& { return c.rate; }, true, true, true,
                      true},
    VariedDisturbance{"delay", [](SensorChannel& c) -> double& { return c.delay; }, true, true,
                      true, true},
    VariedDisturbance{"dropout", [](SensorChannel& c) -> double& { return c.dropout.rate; }, true,
                      true, true, true}};

struct Sensor {
  const char* name;
  std::array<SensorChannel, 3> SensorProfile::*channels;
  bool is_joint;
  bool is_attitude;

  bool has(const VariedDisturbance& disturbance) const {
    return (disturbance.on_joints || !is_joint) && (disturbance.on_attitude || !is_attitude);
  }
};
constexpr std::array sensors = {
    Sensor{"torque", &SensorProfile::torque, true, false},
    Sensor{"position", &SensorProfile::position, true, false},
    Sensor{"velocity", &SensorProfile::velocity, true, false},
    Sensor{"accelerometer", &SensorProfile::accelerometer, false, false},
    Sensor{"gyroscope", &SensorProfile::gyroscope, false, false},
    Sensor{"orientation", &SensorProfile::orientation, false, true}};

constexpr std::array joints = {"hip", "knee", "wheel"};
constexpr std::array axes = {"x", "y", "z"};

/// Finds the entry named `word` among those that `is_known` accepts. Errors: `InputError`.
template <typename Named, typename Known>
const Named& find(const std::string& word, const Named& first, std::size_t count,
                  const Known& is_known) {
  std::vector<std::string> names;
  for (const Named* one = &first; one != &first + count; ++one) {
    if (!is_known(*one)) continue;
    if (one->name == word) return *one;
    names.emplace_back(one->name);
  }
  throw InputError(fmt::format("'{}' is not one of {}{}", word, fmt::join(names, ", "),
                               did_you_mean(word, names)));
}

std::size_t channel_number(const std::string& word, const std::array<const char*, 3>& names) {
  const auto found = std::find(names.begin(), names.end(), word);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  throw InputError(fmt::format("'{}' is not one of {}{}", word, fmt::join(names, ", "),
                               did_you_mean(word, {names.begin(), names.end()})));
}

/// The numbers of the profile that a key names.
std::vector<double*> numbers_of(SensorProfile& profile, std::string_view key) {
  std::vector<std::string> words;
  std::istringstream parts{std::string(key)};
  for (std::string word; std::getline(parts, word, '.');) words.push_back(word);
  if (words.empty() || words.size() > 3) {
    throw InputError("expected a disturbance, of all sensors, one sensor or one channel");
  }
  std::vector<double*> numbers;
  if (words.size() == 1) {
    const VariedDisturbance& disturbance =
        find(words[0], disturbances.front(), disturbances.size(),
             [](const VariedDisturbance& one) { return one.has_no_unit; });
    for (const Sensor& sensor : sensors) {
      if (!sensor.has(disturbance)) continue;
      for (SensorChannel& channel : profile.*sensor.channels) {
        numbers.push_back(&disturbance.of(channel));
      }
    }
    return numbers;
  }
  const Sensor& sensor =
      find(words[0], sensors.front(), sensors.size(), [](const Sensor& /*any*/) { return true; });
  const bool whole = words.size() == 2;
  const VariedDisturbance& disturbance = find(
      words.back(), disturbances.front(), disturbances.size(), [&](const VariedDisturbance& one) {
        return sensor.has(one) && (whole || sensor.is_joint || !one.is_shared_by_axes);
      });
  auto& channels = profile.*sensor.channels;
  if (!whole) {
    return {&disturbance.of(channels[channel_number(words[1], sensor.is_joint ? joints : axes)])};
  }
  for (SensorChannel& channel : channels) numbers.push_back(&disturbance.of(channel));
  return numbers;
}

}  // namespace

SensorProfile with_value(SensorProfile profile, std::string_view key, double value) {
  for (double* number : numbers_of(profile, key)) *number = value;
  // Reading the profile back checks the range of the value.
  from_yaml<SensorProfile>(YamlDocument::parse(to_yaml(profile), fmt::format("{}={}", key, value)));
  return profile;
}

}  // namespace touchdown::noise
