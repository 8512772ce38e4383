#include <array>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "core/table.hpp"
#include "estimator/models/make_estimator.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "estimator/signal_assembler.hpp"
#include "estimator/touchdown.h"
#include "logs/log/recording_file.hpp"
#include "logs/model_file.hpp"
#include "logs/signals_from.hpp"
#include "program.hpp"
#include "tests/bag_writer.hpp"
#include "tests/python_with_numpy.hpp"

namespace touchdown::cli {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double rpm = 360.0 * degree / 60.0;
constexpr double g = 9.80665;

constexpr std::array<const char*, 6> joint_names = {"lh", "lk", "lw", "rh", "rk", "rw"};
/// Its software lists the joints from right to left, wheels first.
constexpr std::array<std::size_t, 6> order = {5, 4, 3, 2, 1, 0};
constexpr double sign_of(std::size_t joint) { return joint < 3 ? 1.0 : -1.0; }
constexpr double zero_of(std::size_t joint) { return joint % 3 == 1 ? 0.25 : 0.0; }
/// Its IMU lies on its side: y points back, x left, and z up.
const Eigen::Matrix3d axes = signed_axes({"y", "x", "-z"});

/// One step of the robot, in its own order, signs, zeros and units: degrees, turns per minute,
/// mN·m that act on the joint from outside, g. Both legs have the same signs, and the knees are
/// zero when bent. The reference of its orientation has z up.
struct Step {
  std::int64_t stamp = 0;  ///< ns
  double time = 0.0;       ///< s
  std::array<JointSignals, 6> joints;
  Eigen::Quaterniond orientation;
  Eigen::Vector3d angular_velocity;
  Eigen::Vector3d acceleration;  ///< gravity included
};

std::vector<Step> steps_of(const logs::Recording& run) {
  std::vector<Step> steps;
  for (std::size_t k = 0; k < run.steps(); ++k) {
    const models::Observation& o = run.observation[k];
    Step& step = steps.emplace_back();
    step.stamp = 5'000'000'000 + 1'000'000 * static_cast<std::int64_t>(k);
    const std::int64_t seconds = step.stamp / 1'000'000'000;
    step.time =
        static_cast<double>(seconds) + 1e-9 * static_cast<double>(step.stamp % 1'000'000'000);
    for (std::size_t i = 0; i < order.size(); ++i) {
      const std::size_t joint = order.at(i);
      const models::ServoReading& servo = o.servo[joint];
      step.joints.at(i) = {(sign_of(joint) * servo.position + zero_of(joint)) / degree,
                           sign_of(joint) * servo.velocity / rpm,
                           -1e3 * sign_of(joint) * servo.torque};
    }
    step.orientation =
        Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0) * o.imu.orientation * Eigen::Quaterniond(axes);
    step.angular_velocity = axes.transpose() * o.imu.angular_velocity / degree;
    step.acceleration = axes.transpose() * o.imu.raw_linear_acceleration / g;
  }
  return steps;
}

/// One mapping file for the bag, the table and the loop: their names are the same.
std::string mapping() {
  return R"(time: {from: header.stamp}
joints:
  names: [lh, lk, lw, rh, rk, rw]
  position: {unit: deg, sign: [1, 1, 1, -1, -1, -1], zero: [0, 0.25, 0, 0, 0.25, 0]}
  velocity: {unit: rpm, sign: [1, 1, 1, -1, -1, -1]}
  torque: {unit: mNm, sign: [-1, -1, -1, 1, 1, 1]}
imu:
  axes: [y, x, -z]
  orientation: {from: [orientation.x, orientation.y, orientation.z, orientation.w], order: xyzw, reference: z_up}
  angular_velocity: {from: [angular_velocity.x, angular_velocity.y, angular_velocity.z], unit: deg/s}
  proper_acceleration: {from: [linear_acceleration.x, linear_acceleration.y, linear_acceleration.z], unit: g}
)";
}

std::string csv_of(const std::vector<Step>& steps) {
  std::string csv = "header.stamp";
  for (const std::size_t joint : order) {
    csv += fmt::format(",{0}/position,{0}/velocity,{0}/effort", joint_names.at(joint));
  }
  csv +=
      ",orientation.w,orientation.x,orientation.y,orientation.z,angular_velocity.x,"
      "angular_velocity.y,angular_velocity.z,linear_acceleration.x,linear_acceleration.y,"
      "linear_acceleration.z\n";
  for (const Step& step : steps) {
    csv += fmt::format("{:.17g}", step.time);
    for (const JointSignals& joint : step.joints) {
      csv += fmt::format(",{:.17g},{:.17g},{:.17g}", joint.position, joint.velocity, joint.torque);
    }
    const Eigen::Quaterniond& q = step.orientation;
    for (const double x : {q.w(), q.x(), q.y(), q.z()}) csv += fmt::format(",{:.17g}", x);
    for (const Eigen::Vector3d& v : {step.angular_velocity, step.acceleration}) {
      csv += fmt::format(",{:.17g},{:.17g},{:.17g}", v.x(), v.y(), v.z());
    }
    csv += "\n";
  }
  return csv;
}

test::TestBag bag_of(const std::vector<Step>& steps) {
  test::TestBag bag{
      {{"/joint_states", "sensor_msgs/msg/JointState"}, {"/imu/data", "sensor_msgs/msg/Imu"}}, {}};
  const auto three = [](const Eigen::Vector3d& v) { return std::array{v.x(), v.y(), v.z()}; };
  for (const Step& step : steps) {
    test::TestJoints joints;
    for (std::size_t i = 0; i < order.size(); ++i) {
      joints.name.emplace_back(joint_names.at(order.at(i)));
      joints.position.push_back(step.joints.at(i).position);
      joints.velocity.push_back(step.joints.at(i).velocity);
      joints.effort.push_back(step.joints.at(i).torque);
    }
    bag.messages.push_back({0, step.stamp, test::joint_state_cdr(step.stamp, joints)});
    const Eigen::Quaterniond& q = step.orientation;
    bag.messages.push_back({1, step.stamp,
                            test::imu_cdr(step.stamp, {{q.x(), q.y(), q.z(), q.w()},
                                                       three(step.angular_velocity),
                                                       three(step.acceleration)})});
  }
  return bag;
}

/// P(contact) of both wheels, both decisions, P(any), P(both) of each step.
using Beliefs = std::vector<std::array<double, 6>>;

Beliefs beliefs_in(const std::filesystem::path& csv) {
  Beliefs beliefs;
  for (const auto& cells : from_csv(read_file(csv)).rows) {
    auto& row = beliefs.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i) row.at(i) = std::stod(cells.at(i + 1));
  }
  return beliefs;
}

Beliefs beliefs_of_program(const std::string& log, const ProgramFolder& folder) {
  folder.output_of("estimate " + log + " -o beliefs.csv");
  return beliefs_in(folder / "beliefs.csv");
}

std::array<double, 6> numbers_of(const Belief& belief) {
  return {belief.wheel[0].p_contact,
          belief.wheel[1].p_contact,
          belief.wheel[0].contact ? 1.0 : 0.0,
          belief.wheel[1].contact ? 1.0 : 0.0,
          belief.p_any_wheel,
          belief.p_both_wheels};
}

/// Of the run that the robot's numbers come from, without its servos' commands.
Beliefs beliefs_of_run(const logs::Recording& run, const std::string& model) {
  const auto estimator = load_estimator(model);
  Beliefs beliefs;
  for (const models::Observation& o : run.observation) {
    beliefs.push_back(numbers_of(estimator->update(logs::signals_from(o, nullptr))));
  }
  return beliefs;
}

Beliefs beliefs_of_cpp(const std::vector<Step>& steps, const std::string& model) {
  AssemblyConfig config;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t joint = order.at(i);
    config.joints.at(joint) = {
        .index = i, .sign = sign_of(joint), .zero = zero_of(joint), .torque_scale = -1.0};
  }
  config.units = {.position = degree,
                  .velocity = rpm,
                  .torque = 1e-3,
                  .angular_velocity = degree,
                  .linear_acceleration = g};
  config.acceleration = AccelerationSource::proper;
  config.reference_is_z_up = true;
  config.axes = axes;
  SignalAssembler assembler(config);
  const auto estimator = load_estimator(model);
  Beliefs beliefs;
  for (const Step& step : steps) {
    const Eigen::Quaterniond& q = step.orientation;
    const Belief& belief =
        estimator->update(assembler.assemble({.time = step.time,
                                              .joints = step.joints,
                                              .orientation = {q.w(), q.x(), q.y(), q.z()},
                                              .angular_velocity = step.angular_velocity,
                                              .proper_acceleration = step.acceleration}));
    EXPECT_FALSE(assembler.faults().any()) << assembler.faults().bits;
    beliefs.push_back(numbers_of(belief));
  }
  return beliefs;
}

Beliefs beliefs_of_c(const std::vector<Step>& steps, const std::string& model) {
  std::array<char, 200> error{};
  touchdown_estimator* const estimator =
      touchdown_create(model.c_str(), nullptr, error.data(), error.size());
  EXPECT_NE(estimator, nullptr) << error.data();
  touchdown_conventions conventions = touchdown_upkie_conventions();
  for (std::size_t i = 0; i < order.size(); ++i) {
    touchdown_joint_source& joint = conventions.joint[order.at(i)];
    joint.index = i;
    joint.sign = sign_of(order.at(i));
    joint.zero = zero_of(order.at(i));
    joint.torque_scale = -1.0;
  }
  conventions.position_unit = conventions.angular_velocity_unit = degree;
  conventions.velocity_unit = rpm;
  conventions.torque_unit = 1e-3;
  conventions.linear_acceleration_unit = g;
  conventions.uses_proper_acceleration = 1;
  conventions.reference_is_z_up = 1;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      conventions.imu_axes[row][column] = axes(row, column);
    }
  }
  EXPECT_EQ(touchdown_set_conventions(estimator, &conventions, error.data(), error.size()), 1)
      << error.data();
  Beliefs beliefs;
  for (const Step& step : steps) {
    touchdown_record record = touchdown_empty_record();
    record.time = step.time;
    for (std::size_t i = 0; i < 6; ++i) {
      const JointSignals& joint = step.joints.at(i);
      record.joint[i] = {joint.position, joint.velocity, joint.torque};
    }
    const Eigen::Quaterniond& q = step.orientation;
    const std::array<double, 4> wxyz = {q.w(), q.x(), q.y(), q.z()};
    std::copy(wxyz.begin(), wxyz.end(), record.orientation);
    std::copy_n(step.angular_velocity.data(), 3, record.angular_velocity);
    std::copy_n(step.acceleration.data(), 3, record.proper_acceleration);
    const touchdown_belief belief = touchdown_update(estimator, &record);
    beliefs.push_back(
        {belief.p_contact[0], belief.p_contact[1], static_cast<double>(belief.contact[0]),
         static_cast<double>(belief.contact[1]), belief.p_any_wheel, belief.p_both_wheels});
  }
  touchdown_destroy(estimator);
  return beliefs;
}

/// The robot's loop in Python, step by step and as a whole: a table as the program prints it.
constexpr const char* loop = R"(
import csv, sys
import numpy as np
import touchdown
with open('robot.csv', newline='') as file:
    rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
estimator = touchdown.Estimator(mapping='robot.yaml')
with open('steps.csv', 'w') as steps:
    steps.write('time,left,right,contact_left,contact_right,any,both\n')
    for row in rows:
        b = estimator.update(row)
        numbers = (*b.p_contact, *map(int, b.contact), b.p_any_wheel, b.p_both_wheels)
        steps.write(','.join(map(repr, (0.0, *numbers))) + '\n')
arrays = {name: np.array([row[name] for row in rows]) for name in rows[0]}
np.savez('robot.npz', **arrays)
bag = touchdown.Recording.load('robot.mcap', mapping='robot.yaml')
for name, b in (('whole', estimator.run(arrays)), ('bag', touchdown.Estimator().run(bag))):
    whole = np.column_stack([np.zeros(len(rows)), b['p_contact'], b['contact'], b['p_any_wheel'], b['p_both_wheels']])
    np.savetxt(name + '.csv', whole, delimiter=',', fmt='%.17g', comments='',
               header='time,left,right,contact_left,contact_right,any,both')
)";

/// An IMU that lies on its side used to be right in a mapping file, and silently wrong in a loop.
TEST(Doors, GiveTheSameBeliefsAboutARobotWithConventionsOfItsOwn) {
  const ProgramFolder folder;
  folder.output_of("simulate " TOUCHDOWN_SOURCE_DIR
                   "/scenarios/hop.yaml --set end.duration=3.2 -o run.mpack");
  const logs::Recording run = logs::read_recording(folder / "run.mpack");
  const std::vector<Step> steps = steps_of(run);
  const std::string model = folder / "m.npz";
  logs::save_model(load_filter_model({}, 1000.0, "upkie"), model);
  const Beliefs expected = beliefs_of_cpp(steps, model);

  const Beliefs of_run = beliefs_of_run(run, model);  // the same but for rounding
  ASSERT_EQ(of_run.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    for (std::size_t i = 0; i < 6; ++i) ASSERT_NEAR(expected[k].at(i), of_run[k].at(i), 1e-6) << k;
  }

  EXPECT_EQ(beliefs_of_c(steps, model), expected);
  folder.write("robot.yaml", mapping());
  folder.write("robot.csv", csv_of(steps));
  std::ofstream(folder / "robot.mcap", std::ios::binary) << test::mcap_bytes(bag_of(steps));
  EXPECT_EQ(beliefs_of_program("robot.csv --mapping robot.yaml", folder), expected);
  EXPECT_EQ(beliefs_of_program("robot.mcap --mapping robot.yaml", folder), expected);
  folder.output_of("export robot.csv --mapping robot.yaml -o robot.mpack");
  EXPECT_EQ(beliefs_of_program("robot.mpack", folder), expected);

  const std::string python = python_with_numpy();
  const auto package = std::filesystem::path(TOUCHDOWN_PROGRAM).parent_path() / "python";
  if (python.empty() || !std::filesystem::exists(package / "touchdown" / "__init__.py")) {
    GTEST_SKIP() << "the Python package is not built, or NumPy is not installed";
  }
  folder.write("loop.py", loop);
  folder.execute("list", fmt::format("PYTHONPATH='{}' {} loop.py;", package.string(), python));
  EXPECT_EQ(beliefs_in(folder / "steps.csv"), expected);
  EXPECT_EQ(beliefs_in(folder / "whole.csv"), expected);
  EXPECT_EQ(beliefs_in(folder / "bag.csv"), expected);
  EXPECT_EQ(beliefs_of_program("robot.npz --mapping robot.yaml", folder), expected);
}

}  // namespace
}  // namespace touchdown::cli
