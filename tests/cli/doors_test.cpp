#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/files.hpp"
#include "core/resources.hpp"
#include "core/table.hpp"
#include "estimator/models/make_estimator.hpp"
#include "estimator/npz/load_estimator.hpp"
#include "estimator/signal_assembler.hpp"
#include "estimator/touchdown.h"
#include "experiments/estimators/registry.hpp"
#include "experiments/logs/robot.hpp"
#include "experiments/signals/run_signals.hpp"
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

constexpr const char* without_python = "the Python package is not built, or NumPy is not installed";

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

/// P(contact) of both wheels, both decisions, P(any), P(both) of each step, and the loads on both
/// wheels with their deviations, -1 if they are not known.
using Numbers = std::array<double, 10>;
using Beliefs = std::vector<Numbers>;

Numbers known(Numbers numbers) {
  for (double& number : numbers) number = std::isnan(number) ? -1.0 : number;
  return numbers;
}

Beliefs beliefs_in(const std::filesystem::path& csv) {
  Beliefs beliefs;
  for (const auto& cells : from_csv(read_file(csv)).rows) {
    Numbers row{};
    for (std::size_t i = 0; i < row.size(); ++i) {
      row.at(i) = std::stod(cells.at(i < 6 ? i + 1 : i + 4));
    }
    beliefs.push_back(known(row));
  }
  return beliefs;
}

Beliefs beliefs_of_program(const std::string& log, const ProgramFolder& folder) {
  folder.output_of("estimate " + log + " -o beliefs.csv");
  return beliefs_in(folder / "beliefs.csv");
}

Numbers numbers_of(const Belief& belief) {
  const auto& [left, right] = belief.wheel;
  return known({left.p_contact, right.p_contact, left.contact ? 1.0 : 0.0,
                right.contact ? 1.0 : 0.0, belief.p_any_wheel, belief.p_both_wheels,
                left.load.force, right.load.force, left.load.deviation, right.load.deviation});
}

Beliefs beliefs_of(ContactEstimator& estimator, const std::vector<Signals>& steps) {
  Beliefs beliefs;
  for (const Signals& signals : steps) beliefs.push_back(numbers_of(estimator.update(signals)));
  return beliefs;
}

/// One call of the C interface.
struct CStep {
  touchdown_record record;
  std::optional<std::array<touchdown_target, 6>> targets = {};
};

/// The beliefs after a reset.
Beliefs beliefs_of_c(const std::string& model, const touchdown_conventions& conventions,
                     const std::vector<CStep>& steps) {
  std::array<char, 200> error{};
  const touchdown_use use = {nullptr, 1000.0, nullptr};
  touchdown_estimator* const estimator =
      touchdown_create(model.c_str(), &use, error.data(), error.size());
  EXPECT_NE(estimator, nullptr) << error.data();
  EXPECT_EQ(touchdown_set_conventions(estimator, &conventions, error.data(), error.size()), 1)
      << error.data();
  Beliefs beliefs;
  for (int again = 0; again < 2; ++again) {
    touchdown_reset(estimator);
    beliefs.clear();
    for (const auto& [record, targets] : steps) {
      const touchdown_belief b =
          targets ? touchdown_update_with_targets(estimator, &record, targets->data())
                  : touchdown_update(estimator, &record);
      beliefs.push_back(known({b.p_contact[0], b.p_contact[1], static_cast<double>(b.contact[0]),
                               static_cast<double>(b.contact[1]), b.p_any_wheel, b.p_both_wheels,
                               b.load[0], b.load[1], b.load_deviation[0], b.load_deviation[1]}));
    }
  }
  touchdown_destroy(estimator);
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
  std::vector<CStep> calls;
  for (const Step& step : steps) {
    touchdown_record& record = calls.emplace_back(CStep{touchdown_empty_record()}).record;
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
  }
  return beliefs_of_c(model, conventions, calls);
}

/// Prints tables as the program does, without the columns that are not compared.
constexpr const char* tables = R"(
import csv, sys
import numpy as np
import touchdown
header = 'time,left,right,contact_left,contact_right,any,both,-,-,-,load_l,load_r,deviation_l,deviation_r'
def save(name, b):
    zero = np.zeros(len(b['p_contact']))
    columns = (zero, b['p_contact'], b['contact'], b['p_any_wheel'], b['p_both_wheels'], zero, zero, zero,
               b['load'], b['load_deviation'])
    np.savetxt(name, np.column_stack(columns), delimiter=',', fmt='%.17g', comments='', header=header)
def save_steps(name, estimator, steps):
    estimator.reset()
    beliefs = [estimator.update(step) for step in steps]
    names = ('p_contact', 'contact', 'p_any_wheel', 'p_both_wheels', 'load', 'load_deviation')
    save(name, {n: np.array([getattr(b, n) for b in beliefs], dtype=float) for n in names})
)";

/// The robot's loop, step by step and as a whole.
constexpr const char* loop = R"(
with open('robot.csv', newline='') as file:
    rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
estimator = touchdown.Estimator(mapping='robot.yaml')
save_steps('steps.csv', estimator, rows)
arrays = {name: np.array([row[name] for row in rows]) for name in rows[0]}
np.savez('robot.npz', **arrays)
bag = touchdown.Recording.load('robot.mcap', mapping='robot.yaml')
save('whole.csv', estimator.run(arrays))
save('bag.csv', touchdown.Estimator().run(bag))
)";

/// Estimators with their models, `=` between them, about a run, as a whole and step by step.
constexpr const char* estimates = R"(
run = touchdown.Recording.load('run.mpack')
for word in sys.argv[1:]:
    name, _, model = word.partition('=')
    estimator = touchdown.Estimator(name, model or None)
    save(name + '_whole.csv', estimator.run(run))
    arrays = {key: np.asarray(value) for key, value in run.items()}
    steps = ({key: value[k] for key, value in arrays.items()} for k in range(run.steps))
    save_steps(name + '_steps.csv', estimator, steps)
    if model == name + '.npz' and name != 'load_filter':
        touchdown.fit(run, name).save(name + '_python.npz')
)";

/// Runs a script with the Python package of this build. Returns false if there is none.
bool ran_python(const ProgramFolder& folder, const std::string& script,
                const std::string& arguments = "") {
  const std::string python = python_with_numpy();
  const auto package = std::filesystem::path(TOUCHDOWN_PROGRAM).parent_path() / "python";
  if (python.empty() || !std::filesystem::exists(package / "touchdown" / "__init__.py")) {
    return false;
  }
  folder.write("doors.py", tables + script);
  const std::string command =
      fmt::format("PYTHONPATH='{}' {} doors.py {} &&", package.string(), python, arguments);
  const Ended ended = folder.execute("list", command);
  EXPECT_EQ(ended.exit_code, 0) << ended.errors;
  return true;
}

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

  // The run itself, without its servos' commands: the same but for rounding.
  std::vector<Signals> signals;
  for (const auto& o : run.observation) signals.push_back(logs::signals_from(o, nullptr));
  const Beliefs of_run = beliefs_of(*load_estimator(model), signals);
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
  folder.output_of("convert robot.csv --mapping robot.yaml -o robot.mpack");
  EXPECT_EQ(beliefs_of_program("robot.mpack", folder), expected);

  if (!ran_python(folder, loop)) GTEST_SKIP() << without_python;
  EXPECT_EQ(beliefs_in(folder / "steps.csv"), expected);
  EXPECT_EQ(beliefs_in(folder / "whole.csv"), expected);
  EXPECT_EQ(beliefs_in(folder / "bag.csv"), expected);
  EXPECT_EQ(beliefs_of_program("robot.npz --mapping robot.yaml", folder), expected);
}

std::vector<CStep> c_steps_of(const logs::Recording& run, const std::vector<Signals>& signals) {
  std::vector<CStep> steps;
  for (std::size_t k = 0; k < run.steps(); ++k) {
    const models::Observation& o = run.observation[k];
    auto& [record, targets] = steps.emplace_back(CStep{touchdown_empty_record()});
    record.time = o.time;
    targets.emplace();
    for (std::size_t i = 0; i < 6; ++i) {
      record.joint[i] = {o.servo[i].position, o.servo[i].velocity, o.servo[i].torque};
      const LegTargets& leg = signals[k].target.at(i / 3);
      const JointTarget& t = i % 3 == 0 ? leg.hip : i % 3 == 1 ? leg.knee : leg.wheel;
      targets->at(i) = {t.position, t.velocity, t.feedforward_torque, t.kp, t.kd};
    }
    const Eigen::Quaterniond& q = o.imu.orientation;
    const std::array<double, 4> wxyz = {q.w(), q.x(), q.y(), q.z()};
    std::copy(wxyz.begin(), wxyz.end(), record.orientation);
    std::copy_n(o.imu.angular_velocity.data(), 3, record.angular_velocity);
    std::copy_n(o.imu.linear_acceleration.data(), 3, record.linear_acceleration);
    record.ground_velocity_command = signals[k].ground_velocity_command;
  }
  return steps;
}

/// The entry of experiments, the program with a file and a stream, the library, C, and Python.
TEST(Doors, GiveTheSameBeliefsByEveryEstimatorAboutARunOfAnotherRobot) {
  const ProgramFolder folder;
  folder.output_of("simulate " TOUCHDOWN_SOURCE_DIR
                   "/scenarios/hop.yaml --set end.duration=3.2 --set "
                   "robot=models/upkie_heavy.yaml -o run.mpack");
  const logs::Recording run = logs::read_recording(folder / "run.mpack");
  const experiments::RunSignals signals =
      experiments::signals_of(run, {}, {}, scoring::SampleUnit::run);
  const auto legs = experiments::checked_robot({}, run.info).legs;
  std::map<std::string, Beliefs> expected;
  std::string words;
  for (const experiments::EstimatorEntry& entry : experiments::estimator_entries()) {
    if (entry.knows.truth) continue;  // no log has an oracle
    SCOPED_TRACE(entry.name);
    std::string file = entry.making.model_file;  // of a network, which comes with the program
    std::string model;
    if (entry.fits()) {
      file = model = entry.name + ".npz";
      folder.output_of("fit run.mpack --no-accuracy --estimator " + entry.name + " -o " + file);
    } else if (entry.name == load_filter_name) {
      file = model = "load_filter.npz";
      folder.output_of("convert models/upkie_heavy.yaml -o " + file);
    }
    const Model fitted = entry.fits() ? load_model(folder / file) : Model{};
    const Beliefs& own = expected[entry.name] =
        beliefs_of(*entry.make({.model = &fitted, .legs = legs}), signals.signals);
    words += fmt::format(" {}={}", entry.name, model);
    const std::string options =
        "--estimator " + entry.name + (model.empty() ? "" : " --model " + model);
    EXPECT_EQ(beliefs_of_program("run.mpack " + options, folder), own);
    folder.execute("estimate - " + options + " -o beliefs.csv < run.mpack");
    EXPECT_EQ(beliefs_in(folder / "beliefs.csv"), own);
    if (model == "load_filter.npz") {
      EXPECT_EQ(beliefs_of_program("run.mpack", folder), own) << "by the robot of the run";
    }
    if (file.empty()) continue;
    const std::filesystem::path path = model.empty() ? find_program_file(file) : folder / file;
    EXPECT_EQ(beliefs_of(*load_estimator(path, {.sample_rate = 1000.0}), signals.signals), own);
    EXPECT_EQ(beliefs_of_c(path.string(), touchdown_upkie_conventions(),
                           c_steps_of(run, signals.signals)),
              own);
  }
  if (!ran_python(folder, estimates, words)) GTEST_SKIP() << without_python;
  for (const auto& [name, own] : expected) {
    EXPECT_EQ(beliefs_in(folder / (name + "_whole.csv")), own) << name;
    EXPECT_EQ(beliefs_in(folder / (name + "_steps.csv")), own) << name;
    if (!experiments::estimator_entry(name).fits()) continue;
    EXPECT_EQ(folder.text(name + "_python.npz"), folder.text(name + ".npz")) << name;
  }
}

}  // namespace
}  // namespace touchdown::cli
