#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/yaml.hpp"
#include "experiments/estimators/registry.hpp"
#include "experiments/results/json.hpp"

namespace touchdown::experiments {

namespace {

struct NamedSensor {
  const char* name;
  bool Sensors::*member;
};

constexpr std::array<NamedSensor, 6> named_sensors = {
    {{"hip_torque", &Sensors::hip_torque},
     {"knee_torque", &Sensors::knee_torque},
     {"wheel_torque", &Sensors::wheel_torque},
     {"acceleration", &Sensors::acceleration},
     {"joint_position", &Sensors::joint_position},
     {"joint_velocity", &Sensors::joint_velocity}}};

}  // namespace

std::vector<std::string> names_of(const Sensors& sensors) {
  std::vector<std::string> names;
  for (const NamedSensor& sensor : named_sensors) {
    if (sensors.*sensor.member) names.emplace_back(sensor.name);
  }
  return names;
}

Sensors sensors_named(const std::vector<std::string>& names, const std::string& source) {
  Sensors sensors;
  const std::vector<std::string> known = names_of({true, true, true, true, true, true});
  for (const std::string& name : names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) {
      throw InputError(fmt::format("{}: sensors: '{}' is not one of {}{}", source, name,
                                   fmt::join(known, ", "), did_you_mean(name, known)));
    }
    sensors.*named_sensors[static_cast<std::size_t>(found - known.begin())].member = true;
  }
  return sensors;
}

std::vector<EstimatorEntry> written_estimators(const std::filesystem::path& run_directory) {
  const std::filesystem::path manifest = run_directory / "manifest.json";
  std::vector<EstimatorEntry> entries;
  if (!is_there(manifest)) return entries;
  try {
    for (const auto& one : nlohmann::json::parse(read_file(manifest))
                               .value("python_estimators", nlohmann::json::array())) {
      EstimatorEntry& entry = entries.emplace_back();
      one.at("name").get_to(entry.name);
      one.at("title").get_to(entry.title);
      one.at("summary").get_to(entry.summary);
      one.at("source").get_to(entry.revision);
      entry.sensors =
          sensors_named(one.at("sensors").get<std::vector<std::string>>(), manifest.string());
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: {}", manifest.string(), reason_of(error)));
  }
  return entries;
}

}  // namespace touchdown::experiments
