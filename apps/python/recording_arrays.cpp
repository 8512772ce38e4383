#include "apps/python/recording_arrays.hpp"

#include <algorithm>
#include <limits>
#include <pybind11/stl.h>
#include <string>

#include <fmt/format.h>

#include "apps/python/signal_arrays.hpp"
#include "core/error.hpp"
#include "logs/signals_from.hpp"

namespace touchdown::python {

namespace {

using Quaternion = std::array<double, 4>;  ///< w x y z
using PerServo = std::array<double, models::servo_count>;

/// Calls `visit` for each member of a row with its name, its first number, the count of numbers (0
/// for a scalar) and their distance (bytes).
template <typename Visit>
void for_each_member(models::Observation& row, const Visit& visit) {
  models::ServoReading& servo = row.servo[0];
  visit("time", row.time, 0, 0);
  visit("position", servo.position, models::servo_count, sizeof servo);
  visit("velocity", servo.velocity, models::servo_count, sizeof servo);
  visit("torque", servo.torque, models::servo_count, sizeof servo);
  visit("angular_velocity", row.imu.angular_velocity.x(), 3, sizeof(double));
  visit("linear_acceleration", row.imu.linear_acceleration.x(), 3, sizeof(double));
  visit("raw_linear_acceleration", row.imu.raw_linear_acceleration.x(), 3, sizeof(double));
  visit("pitch", row.pitch, 0, 0);
  visit("pitch_rate", row.pitch_rate, 0, 0);
  visit("yaw", row.yaw, 0, 0);
  visit("yaw_rate", row.yaw_rate, 0, 0);
}

template <typename Visit>
void for_each_member(models::Action& row, const Visit& visit) {
  models::ServoCommand& servo = row.servo[0];
  const auto per_servo = [&](const char* name, double& first) {
    visit(name, first, models::servo_count, sizeof servo);
  };
  per_servo("command_position", servo.position);
  per_servo("command_velocity", servo.velocity);
  per_servo("command_feedforward_torque", servo.feedforward_torque);
  per_servo("command_kp_scale", servo.kp_scale);
  per_servo("command_kd_scale", servo.kd_scale);
  per_servo("command_maximum_torque", servo.maximum_torque);
}

template <typename Visit>
void for_each_member(models::GroundTruth& row, const Visit& visit) {
  visit("normal_force", row.wheel_normal_force[0], models::wheel_count, sizeof(double));
  visit("base_position", row.base_position.x(), 3, sizeof(double));
  visit("base_linear_velocity", row.base_linear_velocity.x(), 3, sizeof(double));
  visit("base_angular_velocity", row.base_angular_velocity.x(), 3, sizeof(double));
  visit("imu_linear_velocity", row.imu_linear_velocity.x(), 3, sizeof(double));
}

/// An array of one row of numbers per step, copied because they are not contiguous in memory.
template <std::size_t columns, typename Row, typename Of>
py::array_t<double> copied(const std::vector<Row>& rows, const Of& of) {
  std::vector<std::array<double, columns>> values;
  values.reserve(rows.size());
  for (const Row& row : rows) values.push_back(of(row));
  SharedRows<std::array<double, columns>> shared(std::move(values));
  return shared.view(shared.front().data(), columns);
}

Quaternion in_order(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }

template <typename Row>
void add_views(py::dict& arrays, SharedRows<Row>& rows) {
  for_each_member(
      rows.front(), [&](const char* name, double& first, std::size_t columns, std::size_t apart) {
        arrays[name] = columns > 0 ? rows.view(&first, columns, apart) : rows.view(&first);
      });
}

constexpr std::array<std::pair<const char*, double models::ServoReading::*>, 3> held_arrays = {
    {{"held_position", &models::ServoReading::position},
     {"held_velocity", &models::ServoReading::velocity},
     {"held_torque", &models::ServoReading::torque}}};

void add_held_joints(py::dict& arrays, const logs::Recording& recording) {
  const std::size_t count = recording.truth.front().held.size();
  if (count == 0) return;
  for (const auto& [name, member] : held_arrays) {
    py::array_t<double> array({recording.truth.size(), count});
    auto values = array.mutable_unchecked<2>();
    for (std::size_t k = 0; k < recording.truth.size(); ++k) {
      for (std::size_t i = 0; i < std::min(count, recording.truth[k].held.size()); ++i) {
        values(static_cast<py::ssize_t>(k), static_cast<py::ssize_t>(i)) =
            recording.truth[k].held[i].*member;
      }
    }
    arrays[name] = array;
  }
}

/// Adds the ground truth, and contact labels by their default definition.
void add_truth(py::dict& arrays, logs::Recording& recording) {
  arrays["base_orientation"] =
      copied<4>(recording.truth, [](const auto& row) { return in_order(row.base_orientation); });
  if (recording.truth.front().joint_torque) {
    arrays["joint_torque"] = copied<models::servo_count>(
        recording.truth, [](const auto& row) { return row.joint_torque.value_or(PerServo{}); });
  }
  add_held_joints(arrays, recording);
  arrays["contact"] = array_of(scoring::contact_labels(recording, {}));
  SharedRows<models::GroundTruth> rows(std::move(recording.truth));
  add_views(arrays, rows);
  arrays["body_touches_terrain"] = rows.view(&rows.front().body_touches_terrain);
}

/// Adds the targets of the previous step, which were in force when a step was observed.
void add_targets(py::dict& arrays, const logs::Recording& recording) {
  std::vector<std::array<JointTarget, models::servo_count>> rows;
  rows.reserve(recording.steps());
  logs::RecordedJoints storage;
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    if (k > 0) logs::record_of(recording.observation[k], &recording.action[k - 1], storage);
    rows.push_back(storage.targets);
  }
  SharedRows<std::array<JointTarget, models::servo_count>> shared(std::move(rows));
  JointTarget& first = shared.front()[0];
  for (const auto& [name, member] : target_arrays) {
    arrays[name] = shared.view(&(first.*member), models::servo_count, sizeof(JointTarget));
  }
}

/// Adds the signals of estimators that are computed from the recording.
void add_derived_signals(py::dict& arrays, const logs::Recording& recording) {
  std::vector<double> vertical_acceleration;
  std::vector<double> command = {0.0};
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    vertical_acceleration.push_back(
        logs::signals_from(recording.observation[k], 0.0).vertical_acceleration);
    command.push_back(logs::ground_velocity_command(recording.action[k]));
  }
  command.pop_back();  // the command after the last step
  arrays["vertical_acceleration"] = array_of(std::move(vertical_acceleration));
  arrays["ground_velocity_command"] = array_of(std::move(command));
  add_targets(arrays, recording);
}

template <typename Row>
std::vector<Row> rows_from(ArrayMap& map) {
  std::vector<StepArray> columns;
  Row example;
  for_each_member(
      example, [&](const char* name, double& /*first*/, std::size_t count, std::size_t /*apart*/) {
        columns.push_back(map.column(name, count));
      });
  std::vector<Row> rows(map.steps());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    auto column = columns.begin();
    for_each_member(rows[k],
                    [&](const char* /*name*/, double& first, std::size_t count, std::size_t apart) {
                      auto* const bytes = reinterpret_cast<char*>(&first);
                      for (std::size_t i = 0; i < std::max<std::size_t>(count, 1); ++i) {
                        *reinterpret_cast<double*>(bytes + i * apart) = (*column)(k, i);
                      }
                      ++column;
                    });
  }
  return rows;
}

template <typename Row, typename Member>
void read_quaternions(ArrayMap& map, const char* name, std::vector<Row>& rows,
                      const Member& member) {
  const StepArray q = map.column(name, 4);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    member(rows[k]) = Eigen::Quaterniond(q(k, 0), q(k, 1), q(k, 2), q(k, 3));
  }
}

void read_held_joints(ArrayMap& map, std::vector<models::GroundTruth>& rows) {
  const std::size_t count = map.width("held_position");
  for (const auto& [name, member] : held_arrays) {
    if (count == 0) return;
    const StepArray values = map.column(name, count);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      rows[k].held.resize(count);
      for (std::size_t i = 0; i < count; ++i) rows[k].held[i].*member = values(k, i);
    }
  }
}

std::vector<models::GroundTruth> truth_from(ArrayMap& map) {
  std::vector<models::GroundTruth> rows = rows_from<models::GroundTruth>(map);
  read_quaternions(
      map, "base_orientation", rows, [](auto& row) -> auto& { return row.base_orientation; });
  const StepArray body_contact = map.column("body_touches_terrain");
  for (std::size_t k = 0; k < rows.size(); ++k)
    rows[k].body_touches_terrain = body_contact(k) != 0.0;
  read_held_joints(map, rows);
  if (!map.has("joint_torque")) return rows;
  const StepArray torque = map.column("joint_torque", models::servo_count);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    PerServo& joints = rows[k].joint_torque.emplace();
    for (std::size_t i = 0; i < joints.size(); ++i) joints[i] = torque(k, i);
  }
  return rows;
}

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

py::array_t<bool> array_of(const WheelLabels& labels) {
  std::vector<std::array<bool, models::wheel_count>> contact;
  for (std::size_t k = 0; k < labels[0].size(); ++k) {
    contact.push_back({labels[0][k] != 0, labels[1][k] != 0});
  }
  SharedRows<std::array<bool, models::wheel_count>> rows(std::move(contact));
  return rows.view(rows.front().data(), models::wheel_count);
}

py::dict arrays_of(logs::Recording recording) {
  py::dict derived;
  derived["orientation"] = copied<4>(recording.observation,
                                     [](const auto& row) { return in_order(row.imu.orientation); });
  add_derived_signals(derived, recording);
  if (!recording.truth.empty()) add_truth(derived, recording);
  py::dict arrays;
  SharedRows<models::Observation> observation(std::move(recording.observation));
  add_views(arrays, observation);
  arrays.attr("update")(derived);
  SharedRows<models::Action> action(std::move(recording.action));
  add_views(arrays, action);
  return arrays;
}

py::dict dict_of(const logs::RecordingInfo& info) {
  py::dict dict;
  dict["scenario"] = info.scenario;
  dict["simulator"] = info.simulator;
  dict["seed"] = info.seed;
  dict["run"] = info.run;
  dict["control_period_us"] = info.control_period_us;
  dict["outcome"] = info.outcome ? py::cast(logs::to_text(*info.outcome)) : py::none();
  dict["scenario_yaml"] = info.scenario_yaml;
  dict["robot_digest"] = info.robot_digest;
  dict["robot_mass"] = info.robot_mass;
  return dict;
}

logs::RecordingInfo info_of(const py::dict& dict) {
  logs::RecordingInfo info;
  info.scenario = dict["scenario"].cast<std::string>();
  info.simulator = dict["simulator"].cast<std::string>();
  info.seed = dict["seed"].cast<std::uint64_t>();
  info.run = dict["run"].cast<std::int64_t>();
  info.control_period_us = dict["control_period_us"].cast<std::int64_t>();
  if (!dict["outcome"].is_none()) {
    info.outcome = logs::outcome_from_text(dict["outcome"].cast<std::string>());
  }
  info.scenario_yaml = dict["scenario_yaml"].cast<std::string>();
  if (dict.contains("robot_digest")) info.robot_digest = dict["robot_digest"].cast<std::string>();
  if (dict.contains("robot_mass")) info.robot_mass = dict["robot_mass"].cast<double>();
  return info;
}

logs::Recording recording_of(const py::object& arrays, const py::dict& info) {
  logs::Recording recording;
  recording.info = info_of(info);
  ArrayMap map(arrays, "recording");
  recording.observation = rows_from<models::Observation>(map);
  read_quaternions(
      map, "orientation", recording.observation,
      [](auto& row) -> auto& { return row.imu.orientation; });
  recording.action = rows_from<models::Action>(map);
  if (map.has("base_position")) recording.truth = truth_from(map);
  return recording;
}

std::shared_ptr<const logs::Recording> recording_of(const py::object& recording) {
  return std::make_shared<const logs::Recording>(
      recording_of(recording, recording.attr("info").cast<py::dict>()));
}

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
