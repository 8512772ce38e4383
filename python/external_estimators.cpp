#include "python/external_estimators.hpp"

#include <algorithm>
#include <array>
#include <pybind11/stl.h>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/yaml.hpp"
#include "python/belief_arrays.hpp"
#include "python/signal_arrays.hpp"

namespace touchdown::python {

namespace {

/// A Python object that threads without Python's lock may copy and destroy.
std::shared_ptr<const py::object> shared(py::object object) {
  return {new py::object(std::move(object)), [](const py::object* last) {
            const py::gil_scoped_acquire locked;
            delete last;
          }};
}

struct NamedSensor {
  const char* name;
  bool experiments::Sensors::*member;
};
constexpr std::array<NamedSensor, 6> named_sensors = {
    {{"hip_torque", &experiments::Sensors::hip_torque},
     {"knee_torque", &experiments::Sensors::knee_torque},
     {"wheel_torque", &experiments::Sensors::wheel_torque},
     {"acceleration", &experiments::Sensors::acceleration},
     {"joint_position", &experiments::Sensors::joint_position},
     {"joint_velocity", &experiments::Sensors::joint_velocity}}};

experiments::Sensors sensors_of(const std::vector<std::string>& names, const std::string& source) {
  experiments::Sensors sensors;
  std::vector<std::string> known;
  for (const NamedSensor& sensor : named_sensors) known.emplace_back(sensor.name);
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

/// Wraps `run` of a Python estimator for an experiment.
experiments::WholeRunEstimator whole_run_of(const py::object& estimator, const std::string& name,
                                            double sample_rate) {
  return [kept = shared(estimator), name, sample_rate](std::span<const Signals> steps) {
    const py::gil_scoped_acquire locked;
    py::dict signals = arrays_of(std::vector<Signals>(steps.begin(), steps.end()));
    signals["sample_rate"] = sample_rate;
    return beliefs_of(kept->attr("run")(signals), steps.size(), name);
  };
}

experiments::EstimatorEntry entry_of(const py::dict& described) {
  experiments::EstimatorEntry entry;
  entry.name = described["name"].cast<std::string>();
  entry.title = described["title"].cast<std::string>();
  entry.summary = described["summary"].cast<std::string>();
  entry.revision = described["revision"].cast<std::string>();
  entry.sensors = sensors_of(described["sensors"].cast<std::vector<std::string>>(), entry.name);
  entry.whole_run = [make = shared(described["make"]),
                     name = entry.name](const experiments::EstimatorSetup& setup) {
    const py::gil_scoped_acquire locked;
    return whole_run_of((*make)(), name, setup.sample_rate);
  };
  return entry;
}

}  // namespace

std::vector<experiments::EstimatorEntry> external_estimators_of(const py::list& described) {
  std::vector<experiments::EstimatorEntry> entries;
  for (const py::handle& one : described) entries.push_back(entry_of(one.cast<py::dict>()));
  return entries;
}

}  // namespace touchdown::python
