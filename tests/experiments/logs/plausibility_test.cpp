#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/resources.hpp"
#include "logs/plausibility/check.hpp"
#include "logs/signals_from.hpp"
#include "models/robot_model.hpp"
#include "noise/reported_signals.hpp"
#include "noise/sensor_profile.hpp"
#include "scenarios/engine.hpp"
#include "scenarios/generation/generate.hpp"
#include "scenarios/leg_geometry.hpp"
#include "tests/draws.hpp"

namespace touchdown::logs {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double degree = std::numbers::pi / 180.0;

using Records = std::vector<models::Observation>;

/// The findings about a simulated run as its sensors report it.
std::vector<std::string> findings_about(const std::string& scenario, const std::string& simulator,
                                        const std::string& sensors, const std::string& robot = {},
                                        const CheckedRobot& facts = {}) {
  const scenarios::Scenario rollout =
      scenarios::find_scenario("scenarios/" + scenario + ".yaml", robot);
  Recording run = scenarios::play(rollout, simulator);
  noise::report_through(noise::find_sensor_profile("noise/profiles/" + sensors + ".yaml"),
                        {.seed = 7, .run = 0}, run.period(), run.observation);
  PlausibilityCheck check(run.period(), facts);
  for (const models::Observation& record : run.observation) check.add(record);
  return check.findings();
}

/// A simulated run, with a record per millisecond, as its sensors report it.
Records reported(const std::string& scenario, const std::string& simulator,
                 const std::string& sensors) {
  const scenarios::Scenario rollout = scenarios::find_scenario("scenarios/" + scenario + ".yaml");
  Recording run = scenarios::play(rollout, simulator);
  noise::report_through(noise::find_sensor_profile("noise/profiles/" + sensors + ".yaml"),
                        {.seed = 7, .run = 0}, run.period(), run.observation);
  return run.observation;
}

std::vector<std::string> findings(const Records& records) {
  PlausibilityCheck check(1e-3);
  for (const models::Observation& record : records) check.add(record);
  return check.findings();
}

TEST(PlausibilityCheck, IsSilentOnSimulatedRecordings) {
  std::vector<std::string> scenarios = {"stairs", "push_off", "lift_slowly", "lift_drive",
                                        "hang_crouching"};
  if (draws_all()) {
    for (const char* more :
         {"hop", "hang", "roam", "lift", "squat", "put_down", "pushed", "kerb_turn"}) {
      scenarios.emplace_back(more);
    }
  }
  for (const std::string& scenario : scenarios) {
    for (const std::string simulator : {"mujoco", "bullet"}) {
      for (const std::string sensors : {"ideal", "upkie", "harsh"}) {
        EXPECT_THAT(findings_about(scenario, simulator, sensors), IsEmpty())
            << scenario << ' ' << simulator << ' ' << sensors;
      }
    }
  }
}

TEST(PlausibilityCheck, IsSilentOnOtherRobots) {
  for (const std::string robot : {"upkie_straight_actuated", "upkie_heavy", "upkie_long_legs"}) {
    const std::string file = "models/" + robot + ".yaml";
    const CheckedRobot facts{
        .legs = scenarios::leg_geometry(models::compile_robot_model(find_resource(file), {}))};
    for (const std::string sensors : {"ideal", "harsh"}) {
      for (const std::string scenario : {"flat", "hang"}) {
        EXPECT_THAT(findings_about(scenario, "mujoco", sensors, file, facts), IsEmpty())
            << robot << ' ' << scenario << ' ' << sensors;
      }
    }
  }
}

/// One way in which a log is wrong, and a part of the line about it.
struct Damage {
  std::string name;
  std::function<void(models::Observation& record, std::size_t k)> change;
  std::string finding;
  bool needs_turns = false;  ///< faster ones than those of `roam`
  bool needs_drive = false;  ///< accelerations that the attitude's error does not hide
};

/// Applies a factor to one member of some servos.
auto scaled(double models::ServoReading::*member, const std::vector<std::size_t>& servos,
            double factor) {
  return [=](models::Observation& o, std::size_t /*k*/) {
    for (const std::size_t servo : servos) o.servo[servo].*member *= factor;
  };
}

const std::vector<std::size_t> all = {0, 1, 2, 3, 4, 5};
constexpr auto position = &models::ServoReading::position;
constexpr auto velocity = &models::ServoReading::velocity;
constexpr auto torque = &models::ServoReading::torque;

std::vector<Damage> damages() {
  using O = models::Observation;
  const auto swapped = [](std::size_t a, std::size_t b) {
    return [=](O& o, std::size_t) { std::swap(o.servo[a], o.servo[b]); };
  };
  const auto linear_to = [](double factor) {
    return [=](O& o, std::size_t) {
      o.imu.linear_acceleration = factor * o.imu.raw_linear_acceleration;
      o.imu.raw_linear_acceleration =
          o.imu.linear_acceleration - o.imu.orientation.conjugate() * Eigen::Vector3d(0, 0, 9.81);
    };
  };
  const auto proper = [](double factor) {
    return [=](O& o, std::size_t) { o.imu.raw_linear_acceleration *= factor; };
  };
  // Before gravity is removed.
  const auto held_at = [](const Eigen::Vector3d& value) {
    return [=](O& o, std::size_t) {
      o.imu.linear_acceleration += value - o.imu.raw_linear_acceleration;
      o.imu.raw_linear_acceleration = value;
    };
  };
  const auto longer = [](double factor) {
    return [=](O& o, std::size_t) {
      o.imu.orientation.coeffs() *= factor;
      o.imu.linear_acceleration.setConstant(std::nan(""));
    };
  };
  const auto exchanged = [](std::size_t servo) {
    return [=](O& o, std::size_t) { std::swap(o.servo[servo].position, o.servo[servo].velocity); };
  };
  const auto gyroscope = [](const Eigen::Matrix3d& matrix) {
    return [=](O& o, std::size_t) { o.imu.angular_velocity = matrix * o.imu.angular_velocity; };
  };
  const auto negated = [](models::ServoReading& servo) {
    servo = {-servo.position, -servo.velocity, -servo.torque};
  };
  const auto of_servos = [](const std::vector<std::size_t>& servos, const auto& change) {
    return [=](O& o, std::size_t) {
      for (const std::size_t servo : servos) change(o.servo[servo]);
    };
  };
  const auto shifted = [](std::size_t servo, double zero) {
    return [=](O& o, std::size_t) { o.servo[servo].position += zero; };
  };
  // Values of some records before, under right stamps.
  const auto late = [](std::size_t records) {
    return [records, last = std::deque<models::ImuReading>()](O& o, std::size_t) mutable {
      last.push_back(o.imu);
      if (last.size() > records + 1) last.pop_front();
      o.imu = last.front();
    };
  };
  // In all that the IMU reports; z is the vertical.
  const auto turned_imu = [](double angle, int axis = 2) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)));
    return [=](O& o, std::size_t) {
      o.imu.orientation = o.imu.orientation * turn.conjugate();
      o.imu.angular_velocity = turn * o.imu.angular_velocity;
      o.imu.linear_acceleration = turn * o.imu.linear_acceleration;
      o.imu.raw_linear_acceleration = turn * o.imu.raw_linear_acceleration;
    };
  };
  Eigen::Matrix3d x_and_y = Eigen::Matrix3d::Zero();
  x_and_y(0, 1) = x_and_y(1, 0) = x_and_y(2, 2) = 1.0;
  Eigen::Matrix3d cycle = Eigen::Matrix3d::Zero();
  cycle(0, 1) = cycle(1, 2) = cycle(2, 0) = 1.0;
  const auto wrong_order = [](O& o, std::size_t) {
    const Eigen::Quaterniond q = o.imu.orientation;
    o.imu.orientation = Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w());
  };
  return {
      // the whole IMU
      {"IMU upside down", turned_imu(std::numbers::pi, 0),
       "orientation: has the robot upside down"},
      {"IMU on its side", turned_imu(0.5 * std::numbers::pi, 0),
       "orientation: has the robot lie on its side"},
      {"IMU late by 100 ms", late(100), "after the joints: are values older", false, true},
      {"IMU late by 200 ms", late(200), "after the joints: are values older", false, true},
      {"joints late by 200 ms",
       [last = std::deque<std::array<models::ServoReading, 6>>()](O& o, std::size_t) mutable {
         last.push_back(o.servo);
         if (last.size() > 201) last.pop_front();
         o.servo = last.front();
       },
       "after the IMU: are values older", false, true},
      {"accelerations in g",
       [](O& o, std::size_t) {
         o.imu.raw_linear_acceleration /= 9.81;
         o.imu.linear_acceleration = o.imu.raw_linear_acceleration -
                                     o.imu.orientation.conjugate() * Eigen::Vector3d(0, 0, -9.81);
       },
       "while the robot is still, expected 9.8: is it in g"},
      // gravity in the linear acceleration
      {"gravity in it", linear_to(1.0), "linear_acceleration: holds gravity: mean 9."},
      {"gravity in it, in g", linear_to(1.0 / 9.81), "holds gravity in g"},
      {"gravity twice", linear_to(2.0), "linear_acceleration: mean 19"},
      // proper acceleration
      {"proper in g", proper(1.0 / 9.81), "is it in g"},
      {"proper in mg", proper(1e3 / 9.81), "is it in mg"},
      {"proper converted twice", proper(9.81), "converted from g twice"},
      {"proper without gravity",
       [](O& o, std::size_t) { o.imu.raw_linear_acceleration = 0.9 * o.imu.linear_acceleration; },
       "gravity was removed"},
      {"accelerometer of zeros", held_at(Eigen::Vector3d::Zero()),
       "proper_acceleration: is 0 0 0 throughout: is the sensor dead"},
      {"accelerometer that never changes", held_at({0.25, 0.5, -9.75}),
       "proper_acceleration: is 0.25 0.5 -9.75 throughout: is the sensor dead"},
      {"accelerometer without its z axis",
       [](O& o, std::size_t) {
         o.imu.linear_acceleration.z() -= o.imu.raw_linear_acceleration.z();
         o.imu.raw_linear_acceleration.z() = 0.0;
       },
       "proper_acceleration z: it is 0 throughout"},
      // orientation
      {"quaternion of length 2", longer(2.0), "orientation: is never a quaternion of length 1"},
      {"quaternion of length 0", longer(0.0), "orientation: is never a quaternion of length 1"},
      {"quaternion of length 100 at times",
       [](O& o, std::size_t k) {
         if (k % 10 == 0) o.imu.orientation.coeffs() *= 100.0;
       },
       "orientation: is missing in 10 % of the records"},
      {"x y z w as w x y z", wrong_order, "proper_acceleration: points"},
      {"inverse orientation of a pitched IMU",
       [](O& o, std::size_t) {
         o.imu.orientation = o.imu.orientation * Eigen::Quaterniond(0.8, 0, 0.6, 0);
         o.imu.orientation = o.imu.orientation.conjugate();
       },
       "proper_acceleration: points"},
      {"z up as z down",
       [](O& o, std::size_t) {
         o.imu.orientation = Eigen::Quaterniond(0, 1, 0, 0) * o.imu.orientation;
       },
       "proper_acceleration: points 1"},
      // torques
      {"all torques negated", scaled(torque, all, -1.0),
       "probably the torques have the other sign"},
      {"hips and knees negated", scaled(torque, {0, 1, 3, 4}, -1.0),
       "probably the torques have the other sign"},
      {"sides swapped in the torques",
       [](O& o, std::size_t) {
         for (std::size_t i = 0; i < 3; ++i) std::swap(o.servo[i].torque, o.servo[i + 3].torque);
       },
       "probably the torques have the other sign"},
      {"right leg negated", scaled(torque, {3, 4, 5}, -1.0),
       "torques of the right leg have the other sign"},
      {"left leg negated", scaled(torque, {0, 1, 2}, -1.0),
       "torques of the left leg have the other sign"},
      {"torques in mNm", scaled(torque, all, 1000.0), "are they in mN·m"},
      {"torques in cNm", scaled(torque, all, 100.0), "are they in cN·m"},
      {"torques of hips and knees swapped",
       [](O& o, std::size_t) {
         std::swap(o.servo[0].torque, o.servo[1].torque);
         std::swap(o.servo[3].torque, o.servo[4].torque);
       },
       "probably the torques of hips and knees are exchanged", false, true},
      {"torques divided by 1000", scaled(torque, all, 1e-3), "never exceed"},
      {"torques times 0.1", scaled(torque, all, 0.1), "the torques are 0.", false, true},
      {"torques in kgf·cm", scaled(torque, all, 10.197), "are they in kgf·cm"},
      {"torques of left and right knee exchanged",
       [](O& o, std::size_t) { std::swap(o.servo[1].torque, o.servo[4].torque); },
       "the torques of the knees have the other sign, or are those of the other side", false, true},
      // joints
      {"left and right knee exchanged", swapped(1, 4), "in front of the hips", false, true},
      {"left and right hip exchanged", swapped(0, 3), "behind the hips", false, true},
      {"the left knee's position negated", scaled(position, {1}, -1.0),
       "probably the position of left_knee has the other sign", false, true},
      {"the right knee's position negated", scaled(position, {4}, -1.0),
       "probably the position of right_knee has the other sign", false, true},
      {"positions of left and right hip exchanged",
       [](O& o, std::size_t) { std::swap(o.servo[0].position, o.servo[3].position); },
       "probably the positions of the hips have the other sign, or are those of the other side",
       false, true},
      {"positions of left and right knee exchanged",
       [](O& o, std::size_t) { std::swap(o.servo[1].position, o.servo[4].position); },
       "probably the positions of the knees have the other sign, or are those of the other side",
       false, true},
      {"position and velocity of a wheel exchanged", exchanged(2),
       "left_wheel: position follows the derivative of velocity: are the two exchanged"},
      {"position and velocity of the right wheel exchanged", exchanged(5),
       "right_wheel: position follows the derivative of velocity: are the two exchanged"},
      {"the left knee's zero", shifted(1, 0.3), "left_knee: the left wheel is", false, true},
      {"the right hip's zero", shifted(3, -0.3), "right_hip: the left wheel is", false, true},
      {"encoders in revolutions",
       [](O& o, std::size_t) {
         for (models::ServoReading& servo : o.servo) {
           servo.position /= 2.0 * std::numbers::pi;
           servo.velocity /= 2.0 * std::numbers::pi;
         }
       },
       "probably positions are in revolutions", false, true},
      {"hips and knees swapped",
       [](O& o, std::size_t) {
         std::swap(o.servo[0], o.servo[1]);
         std::swap(o.servo[3], o.servo[4]);
       },
       "hips and knees"},
      {"knee and wheel swapped", swapped(1, 2), "left_knee: position leaves its range"},
      {"hip and wheel swapped", swapped(3, 5), "right_hip: position leaves its range"},
      // legs and wheels against the mirror image
      {"right leg counted like the left one", of_servos({3, 4, 5}, negated),
       "wheels: turn in opposite directions"},
      {"left leg counted like the right one", of_servos({0, 1, 2}, negated),
       "wheels: turn in opposite directions"},
      {"one wheel counted the other way", of_servos({2}, negated),
       "wheels: turn in opposite directions"},
      {"all joints counted the other way", of_servos(all, negated), "wheels: drive backwards",
       false, true},
      {"wheels counted the other way", of_servos({2, 5}, negated), "wheels: drive backwards", false,
       true},
      {"left and right swapped",
       [](O& o, std::size_t) {
         for (std::size_t i = 0; i < 3; ++i) std::swap(o.servo[i], o.servo[i + 3]);
       },
       "wheels: drive backwards", false, true},
      {"IMU mounted backwards", turned_imu(std::numbers::pi), "wheels: drive backwards", false,
       true},
      {"IMU mounted sideways", turned_imu(0.5 * std::numbers::pi),
       "linear_acceleration: its y axis follows the wheels", false, true},
      {"IMU mounted sideways, the other way", turned_imu(-0.5 * std::numbers::pi),
       "linear_acceleration: its y axis follows the wheels", false, true},
      // velocity against position
      {"velocities in deg/s", scaled(velocity, all, 1.0 / degree), "is the velocity in deg/s"},
      {"velocities in rpm", scaled(velocity, all, 30.0 / std::numbers::pi),
       "is the velocity in rpm"},
      {"velocities in rev/s", scaled(velocity, all, 0.5 / std::numbers::pi), "in rev/s"},
      {"wheel velocities negated", scaled(velocity, {2, 5}, -1.0),
       "left_wheel, right_wheel: velocity has the other sign"},
      {"wheel positions negated", scaled(position, {2, 5}, -1.0),
       "left_wheel, right_wheel: velocity has the other sign"},
      {"velocities in another unit of time", scaled(velocity, all, 1.5),
       "is 1.5 times the derivative"},
      {"a gear ratio of 6", scaled(velocity, {2, 5}, 6.0), "is 6 times the derivative"},
      {"sides swapped in wheel velocities",
       [](O& o, std::size_t) { std::swap(o.servo[2].velocity, o.servo[5].velocity); },
       "velocity has the other sign"},
      // degrees
      {"positions in degrees", scaled(position, all, 1.0 / degree), "is it in degrees"},
      {"knees in degrees", scaled(position, {1, 4}, 1.0 / degree),
       "left_knee, right_knee: position leaves its range"},
      // gyroscope
      {"gyroscope in deg/s", gyroscope(Eigen::Matrix3d::Identity() / degree), "is it in deg/s"},
      {"gyroscope negated", gyroscope(-Eigen::Matrix3d::Identity()), "turns the other way", true},
      {"gyroscope with other axes", gyroscope(x_and_y), "angular_velocity: fits the orientation as",
       true},
      {"gyroscope in cyclic order", gyroscope(cycle), "angular_velocity: fits the orientation as",
       true},
      {"gyroscope mapped as deg/s", gyroscope(degree * Eigen::Matrix3d::Identity()),
       "mapped as deg/s", true},
      {"gyroscope's y axis negated",
       gyroscope(Eigen::Vector3d(1.0, -1.0, 1.0).asDiagonal().toDenseMatrix()),
       "turns the other way than the orientation", true},
      {"gyroscope's y axis in deg/s",
       gyroscope(Eigen::Vector3d(1.0, 1.0 / degree, 1.0).asDiagonal().toDenseMatrix()),
       "angular_velocity y: is", true},
      // dead channels
      {"knees silent", scaled(torque, {1, 4}, 0.0),
       "left_knee, right_knee: torque is 0 throughout"},
      {"a torque that is stuck", [](O& o, std::size_t) { o.servo[0].torque = 0.25; },
       "left_hip: torque is 0.25 throughout"},
      {"velocities silent", scaled(velocity, {2, 5}, 0.0),
       "left_wheel, right_wheel: velocity is 0"},
      {"gyroscope silent", gyroscope(Eigen::Matrix3d::Zero()),
       "angular_velocity: is 0 0 0 throughout"},
      {"accelerometer silent", linear_to(0.0), "linear_acceleration: is 0 0 0 throughout"},
      {"one axis silent", [](O& o, std::size_t) { o.imu.linear_acceleration.y() = 0.0; },
       "linear_acceleration y: it is 0 throughout"},
      {"orientation silent",
       [](O& o, std::size_t) { o.imu.orientation = Eigen::Quaterniond(0, 0, 1, 0); },
       "orientation: never changes"},
      // missing values
      {"a torque that is often missing",
       [](O& o, std::size_t k) {
         if (k % 5 == 0) o.servo[4].torque = std::nan("");
       },
       "right_knee: torque is missing in 20 % of the records"},
      {"no gyroscope", [](O& o, std::size_t) { o.imu.angular_velocity.setConstant(std::nan("")); },
       "angular_velocity: is never a finite number"},
      // clock
      {"half of the rate",
       [](O& o, std::size_t k) {
         if (k > 4000) o.time += 1e-3 * static_cast<double>(k - 4000);
       },
       "time: the rate changes: 500 Hz at 4."},
      {"twice the rate",
       [](O& o, std::size_t k) {
         if (k > 3000) o.time -= 5e-4 * static_cast<double>(k - 3000);
       },
       "time: the rate changes: 2000 Hz at 3."},
      {"times in pairs",
       [](O& o, std::size_t k) { o.time = 1e-3 * static_cast<double>(k - k % 2); },
       "time: is that of the record before"},
      {"a torque that stops",
       [](O& o, std::size_t k) {
         if (k > 2500) o.servo[1].torque = 0.0;
       },
       "left knee torque: repeats 0 from 2.5"},
      {"torques that stop",
       [](O& o, std::size_t k) {
         for (models::ServoReading& servo : o.servo) servo.torque = k > 2500 ? 0.0 : servo.torque;
       },
       "right knee torque, right wheel torque: repeats 0 from 2.5"},
      {"an accelerometer that stops",
       [](O& o, std::size_t k) {
         if (k > 2500) o.imu.linear_acceleration.z() = 0.125;
       },
       "acceleration z: repeats 0.125 from 2.5"},
      {"one that stops before gravity is removed",
       [](O& o, std::size_t k) {
         Eigen::Vector3d& measured = o.imu.raw_linear_acceleration;
         const Eigen::Vector3d gravity = o.imu.linear_acceleration - measured;
         if (k > 2500) measured.z() = -9.75;
         o.imu.linear_acceleration = measured + gravity;
       },
       "acceleration z: repeats -9.75 from 2.5"},
      {"servos in a limit cycle",
       [](O& o, std::size_t k) {
         if (k / 200 % 10 == 7) o.servo[0].torque = o.servo[4].torque = k % 2 == 0 ? 6.0 : -9.0;
       },
       "left_hip, right_knee: torque changes its sign in most records"},
      {"a step back",
       [](O& o, std::size_t k) {
         if (k > 2500) o.time -= 0.2;
       },
       "time: goes back once, by up to 0.199 s"},
      {"a jump",
       [](O& o, std::size_t k) {
         if (k > 2500) o.time += 3600.0;
       },
       "time: jumps once"},
  };
}

TEST(PlausibilityCheck, NamesEveryKindOfDamage) {
  const std::vector<std::pair<std::string, Records>> undamaged = {
      {"ideal hop", reported("hop", "mujoco", "ideal")},
      {"upkie roam", reported("roam", "bullet", "upkie")},
      {"ideal roam that drives", reported("roam", "mujoco", "ideal")},
      {"upkie flat that drives", reported("flat", "bullet", "upkie")}};
  for (const auto& [name, records] : undamaged) {
    for (const Damage& damage : damages()) {
      if (damage.needs_turns && name == "upkie roam") continue;
      if (damage.needs_drive != name.ends_with("drives")) continue;
      Records changed = records;
      for (std::size_t k = 0; k < changed.size(); ++k) damage.change(changed[k], k);
      const std::vector<std::string> lines = findings(changed);
      EXPECT_THAT(lines, Contains(HasSubstr(damage.finding))) << damage.name << ", " << name;
      if (std::getenv("TOUCHDOWN_PRINT_FINDINGS") != nullptr) {
        fmt::print("| {} | {} | {} |\n", name, damage.name, fmt::join(lines, "; "));
      }
    }
  }
}

/// A robot that turns about two axes shows it, whatever the frames of its IMU.
TEST(PlausibilityCheck, NamesTheOrderInWhichAQuaternionWasMisread) {
  const Records records = reported("kerb_turn", "mujoco", "ideal");
  for (const std::array<const char*, 3> axes :
       {std::array{"x", "y", "z"}, {"-x", "y", "-z"}, {"-y", "-x", "-z"}, {"z", "x", "y"}}) {
    for (const bool is_z_up : {false, true}) {
      for (const bool is_w_last : {false, true}) {
        AssemblyConfig config;
        config.axes = signed_axes({axes[0], axes[1], axes[2]});
        config.reference_is_z_up = is_z_up;
        const Eigen::AngleAxisd reference(is_z_up ? std::numbers::pi : 0.0,
                                          Eigen::Vector3d::UnitX());
        PlausibilityCheck right(1e-3, {}, 0.0, {is_w_last, is_z_up, config.axes});
        PlausibilityCheck misread = right;
        for (models::Observation record : records) {
          const Eigen::Quaterniond q =
              reference.inverse() * record.imu.orientation * Eigen::Quaterniond(config.axes);
          right.add(record);
          RobotRecord read;
          read.orientation = is_w_last ? std::array{q.z(), q.w(), q.x(), q.y()}
                                       : std::array{q.x(), q.y(), q.z(), q.w()};
          const auto& [w, x, y, z] = imu_of(read, config).orientation;
          record.imu.orientation = Eigen::Quaterniond(w, x, y, z);
          misread.add(record);
        }
        EXPECT_THAT(right.findings(), IsEmpty());
        EXPECT_THAT(
            misread.findings(),
            Contains(HasSubstr(is_w_last ? "if its numbers are w, x, y, z: they were read as x"
                                         : "if its numbers are x, y, z, w: they were read as w")))
            << axes[0] << axes[1] << axes[2] << is_z_up;
      }
    }
  }
}

/// One that drives sways by less than the bias of its gyroscope.
TEST(PlausibilityCheck, NamesAnOrientationThatStopsWhileTheRobotDrives) {
  for (const std::string scenario : {"flat", "stairs", "washboard"}) {
    Records records = reported(scenario, "bullet", "upkie");
    for (std::size_t k = 1500; k < 3500; ++k) {
      records[k].imu.orientation = records[1499].imu.orientation;
    }
    EXPECT_THAT(findings(records), Contains(HasSubstr("orientation: repeats itself from 1.")))
        << scenario;
  }
}

/// Their size is no cause of its own, nor is what follows from it.
TEST(PlausibilityCheck, NamesOneCauseOfSizesWithoutSignsAndOfVelocitiesInRpm) {
  for (const std::string scenario : {"flat", "hop", "roam"}) {
    const Records records = reported(scenario, "mujoco", "ideal");
    Records sizes = records;
    Records rpm = records;
    for (std::size_t k = 0; k < records.size(); ++k) {
      for (models::ServoReading& servo : sizes[k].servo) servo.torque = std::abs(servo.torque);
      for (models::ServoReading& servo : rpm[k].servo) servo.velocity *= 30.0 / std::numbers::pi;
    }
    EXPECT_THAT(findings(sizes), ::testing::ElementsAre(HasSubstr("never change their sign")))
        << scenario;
    EXPECT_THAT(findings(rpm), ::testing::Each(HasSubstr("in rpm"))) << scenario;
  }
}

/// One record is too little for a mean to show, or for all means to be wrong.
TEST(PlausibilityCheck, NamesASingleValueThatNoSensorReports) {
  const Records records = reported("hop", "mujoco", "ideal");
  using O = models::Observation;
  const struct {
    const char* finding;
    std::function<void(O&)> change;
  } cases[] = {
      {"left_hip: velocity is 1e+39 rad/s", [](O& o) { o.servo[0].velocity = 1e39; }},
      {"right_knee: torque is -20000 N·m", [](O& o) { o.servo[4].torque = -2e4; }},
      {"left_knee: position is 1e+308 rad", [](O& o) { o.servo[1].position = 1e308; }},
      {"right_wheel: position is -1e+308 rad", [](O& o) { o.servo[5].position = -1e308; }},
      {"left_wheel: velocity is 100000 rad/s", [](O& o) { o.servo[2].velocity = 1e5; }},
      {"orientation: is 1e+200", [](O& o) { o.imu.orientation.x() = 1e200; }},
      {"angular_velocity: is 1e+30 rad/s", [](O& o) { o.imu.angular_velocity.y() = 1e30; }},
      {"linear_acceleration: is 1e+300 m/s²", [](O& o) { o.imu.linear_acceleration.z() = 1e300; }},
      {"proper_acceleration: is -1e+300 m/s²",
       [](O& o) { o.imu.raw_linear_acceleration.z() = -1e300; }},
  };
  for (const auto& [finding, change] : cases) {
    for (const std::size_t at : {std::size_t{0}, std::size_t{150}, records.size() - 1}) {
      Records changed = records;
      change(changed[at]);
      const std::vector<std::string> lines = findings(changed);
      EXPECT_THAT(lines, ::testing::ElementsAre(HasSubstr(finding))) << at;
    }
  }
}

/// Legs that are nearly straight carry a robot with small torques. Those of the other sign, order
/// or unit then look like those of a robot that hangs; but it drives.
TEST(PlausibilityCheck, NamesALoadThatIsTooSmallForARobotThatDrives) {
  using O = models::Observation;
  const std::vector<std::pair<std::string, std::function<void(O&)>>> damages_of_load = {
      {"probably the torques of hips and knees are exchanged",
       [](O& o) {
         std::swap(o.servo[0].torque, o.servo[1].torque);
         std::swap(o.servo[3].torque, o.servo[4].torque);
       }},
      {"the torques of the left leg have the other sign",
       [](O& o) {
         for (const std::size_t i : {0U, 1U, 2U}) o.servo[i].torque *= -1.0;
       }},
      {"the torques of the right leg have the other sign",
       [](O& o) {
         for (const std::size_t i : {3U, 4U, 5U}) o.servo[i].torque *= -1.0;
       }},
      {"times those that carry its weight", [](O& o) {
         for (models::ServoReading& servo : o.servo) servo.torque /= 6.0;
       }}};
  for (const std::string robot : {"upkie.xml", "upkie_straight.yaml"}) {
    const scenarios::Scenario rollout =
        scenarios::find_scenario("scenarios/roam.yaml", "models/" + robot);
    const Recording run = scenarios::play(rollout, "mujoco");
    const CheckedRobot upkie{.legs = LegGeometry{}};
    PlausibilityCheck undamaged(run.period(), upkie);
    for (const O& record : run.observation) undamaged.add(record);
    EXPECT_THAT(undamaged.findings(), IsEmpty()) << robot;
    for (const auto& [finding, change] : damages_of_load) {
      PlausibilityCheck check(run.period(), upkie);
      for (O record : run.observation) {
        change(record);
        check.add(record);
      }
      EXPECT_THAT(check.findings(), Contains(HasSubstr(finding))) << robot;
    }
  }
}

/// Legs that crouch while the robot drives, so that gains show, too.
TEST(PlausibilityCheck, NamesTargetsThatDoNotGiveTheMeasuredTorques) {
  using Targets = ServoTargets;
  const auto of_legs = [](const std::function<void(JointTarget&)>& change) {
    return [=](Targets& targets) {
      for (LegTargets& leg : targets) {
        change(leg.hip);
        change(leg.knee);
      }
    };
  };
  const std::vector<std::pair<std::string, std::function<void(Targets&)>>> cases = {
      {"", [](Targets&) {}},
      {"probably have the other sign", of_legs([](JointTarget& t) { t.position *= -1.0; })},
      {"in degrees", of_legs([](JointTarget& t) { t.position /= degree; })},
      {"of the other leg",
       [](Targets& targets) {
         // Legs that mirror each other would have the other sign.
         targets[0].hip.position += 0.5;
         std::swap(targets[0], targets[1]);
       }},
      {"times the measured torques", of_legs([](JointTarget& t) {
         t.kp *= 10.0;
         t.kd *= 10.0;
       })}};
  for (const std::string simulator : {"mujoco", "bullet"}) {
    for (const std::string sensors : {"ideal", "harsh"}) {
      Recording run = scenarios::play(scenarios::find_scenario("scenarios/stairs.yaml"), simulator);
      noise::report_through(noise::find_sensor_profile("noise/profiles/" + sensors + ".yaml"),
                            {.seed = 7, .run = 0}, run.period(), run.observation);
      for (const auto& [finding, change] : cases) {
        PlausibilityCheck check(run.period());
        StepSignals steps(1e3);
        for (std::size_t k = 0; k < run.steps(); ++k) {
          Targets targets = steps.next(run.observation[k], run.action[k]).target;
          change(targets);
          check.add(run.observation[k], targets);
        }
        const std::vector<std::string> lines = check.findings();
        if (finding.empty()) {
          EXPECT_THAT(lines, IsEmpty()) << simulator << ' ' << sensors;
        } else {
          EXPECT_THAT(lines, Contains(HasSubstr(finding))) << simulator << ' ' << sensors;
        }
      }
      PlausibilityCheck check(run.period());
      StepSignals steps(1e3);
      for (std::size_t k = 0; k < run.steps(); ++k) {
        models::Observation record = run.observation[k];
        const Targets targets = steps.next(record, run.action[k]).target;
        for (const std::size_t hip : {0U, 3U}) {
          std::swap(record.servo[hip].torque, record.servo[hip + 1].torque);
        }
        check.add(record, targets);
      }
      EXPECT_THAT(check.findings(), Contains(HasSubstr("the knee at the hip by the servo's law")))
          << simulator << ' ' << sensors;
    }
  }
}

TEST(PlausibilityCheck, TakesAHipThatTheRobotLacksAsItIs) {
  Records records = reported("hop", "mujoco", "ideal");
  for (models::Observation& o : records) o.servo[0] = o.servo[3] = {};
  for (const std::string& line : findings(records))
    EXPECT_THAT(line, ::testing::Not(HasSubstr("hip")));
}

TEST(PlausibilityCheck, HasNoFindingsWithoutRecords) {
  EXPECT_THAT(findings({}), IsEmpty());
  EXPECT_THAT(findings(Records(1)), IsEmpty());
}

}  // namespace
}  // namespace touchdown::logs
