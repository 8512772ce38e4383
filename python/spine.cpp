#include "python/module.hpp"

#include <limits>
#include <string>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::python {

namespace {

namespace py = pybind11;

[[noreturn]] void refuse(const std::string& path, const char* expected) {
  throw InputError(fmt::format("{}: expected {}", path, expected));
}

/// A dictionary in a dictionary; an empty one if it is missing.
py::dict section_of(const py::dict& parent, const char* key, const std::string& path) {
  if (!parent.contains(key) || parent[key].is_none()) return {};
  if (!py::isinstance<py::dict>(parent[key])) refuse(path, "a dictionary");
  return parent[key];
}

double number_of(const py::handle& value, const std::string& path) {
  if (value.is_none()) return std::numeric_limits<double>::quiet_NaN();
  const double number = PyBool_Check(value.ptr()) != 0 ? -1.0 : PyFloat_AsDouble(value.ptr());
  if (PyBool_Check(value.ptr()) != 0 || PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    refuse(path, "a number");
  }
  return number;
}

double number_in(const py::dict& parent, const char* key, const std::string& path) {
  return number_of(parent.contains(key) ? py::object(parent[key]) : py::none(), path + key);
}

/// The numbers of anything with a length and items: a list, a tuple, an array.
template <std::size_t count>
std::array<double, count> vector_in(const py::dict& parent, const char* key,
                                    const std::string& path) {
  std::array<double, count> numbers;
  numbers.fill(std::numeric_limits<double>::quiet_NaN());
  if (!parent.contains(key) || parent[key].is_none()) return numbers;
  const py::object vector = parent[key];
  if (!py::hasattr(vector, "__len__") || py::len(vector) != count) {
    refuse(path + key, count == 4 ? "four numbers: w, x, y, z" : "three numbers");
  }
  for (std::size_t i = 0; i < count; ++i) {
    numbers[i] = number_of(vector[py::int_(i)], fmt::format("{}{}.{}", path, key, i));
  }
  return numbers;
}

}  // namespace

models::Observation observation_of(const py::dict& spine, double time) {
  for (const char* key : {"servo", "imu"}) {
    if (spine.contains(key)) continue;
    throw InputError(
        fmt::format("observation: '{}' is missing: expected info['spine_observation'], or the "
                    "observation of a log's record",
                    key));
  }
  models::Observation observation;
  const bool has_time = spine.contains("time") && !spine["time"].is_none();
  observation.time = has_time ? number_of(spine["time"], "observation.time") : time;
  const py::dict servos = section_of(spine, "servo", "observation.servo");
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    const std::string name(models::servo_names[i]);
    const std::string path = "observation.servo." + name;
    const py::dict servo = section_of(servos, name.c_str(), path);
    observation.servo[i] = {number_in(servo, "position", path + "."),
                            number_in(servo, "velocity", path + "."),
                            number_in(servo, "torque", path + ".")};
  }
  const py::dict imu = section_of(spine, "imu", "observation.imu");
  const std::string path = "observation.imu.";
  const auto q = vector_in<4>(imu, "orientation", path);
  observation.imu.orientation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  observation.imu.angular_velocity =
      Eigen::Vector3d(vector_in<3>(imu, "angular_velocity", path).data());
  observation.imu.linear_acceleration =
      Eigen::Vector3d(vector_in<3>(imu, "linear_acceleration", path).data());
  return observation;
}

}  // namespace touchdown::python
