#include "models/robot_model.hpp"

#include <cmath>
#include <filesystem>
#include <map>
#include <new>
#include <set>
#include <tinyxml2.h>

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/models/upkie.hpp"

namespace touchdown::models {
namespace {

double total_mass(const mjModel& model) {
  double mass = 0.0;
  for (int body = 0; body < model.nbody; ++body) mass += model.body_mass[body];
  return mass;
}

TEST(Upkie, WheelAxlesAre507MillimetresBelowTheBase) {
  const RobotModel robot = compile_robot_model(upkie_mjcf, Terrain{});
  const MjDataPtr data(mj_makeData(robot.mj.get()));
  mj_forward(robot.mj.get(), data.get());
  for (std::size_t i = 0; i < wheel_count; ++i) {
    const int geom = robot.tyre_geom[i];
    EXPECT_NEAR(data->geom_xpos[3 * geom + 2] - data->qpos[2], -0.507, 1e-12);
    EXPECT_NEAR(data->geom_xpos[3 * geom + 1], i == 0 ? 0.1524 : -0.1524, 1e-12);
  }
  EXPECT_EQ(robot.wheel_radius, 0.05);
  EXPECT_LT((robot.imu_position - Eigen::Vector3d(0.0, 0.0, -0.1)).norm(), 1e-12);
}

TEST(Upkie, HasTheMassAndTheServosOfTheRobot) {
  const RobotModel robot = compile_robot_model(upkie_mjcf, Terrain{});
  EXPECT_EQ(robot.name, "upkie");
  EXPECT_NEAR(total_mass(*robot.mj), 5.33922, 1e-5);
  const std::array<double, servo_count> effort = {16, 16, 1.7, 16, 16, 1.7};
  EXPECT_EQ(robot.effort, effort);
  for (std::size_t i = 0; i < servo_count; ++i) {
    const int joint = mj_name2id(robot.mj.get(), mjOBJ_JOINT, std::string(servo_names[i]).c_str());
    const bool wheel = i % 3 == 2;
    EXPECT_EQ(robot.mj->jnt_limited[joint], wheel ? 0 : 1);
    if (!wheel) {
      EXPECT_EQ(robot.mj->jnt_range[2 * joint + 1], i % 3 == 0 ? 1.26 : 2.51);
    }
    EXPECT_EQ(robot.qpos_address[i], 7 + static_cast<int>(i));
    EXPECT_EQ(robot.dof_address[i], 6 + static_cast<int>(i));
  }
}

/// Signs of the real robot: left hip + swings the left foot forward, the right one is mirrored.
TEST(Upkie, JointsTurnTheRightWay) {
  const RobotModel robot = compile_robot_model(upkie_mjcf, Terrain{});
  const MjDataPtr data(mj_makeData(robot.mj.get()));
  data->qpos[robot.qpos_address[index(Servo::left_hip)]] = 0.3;
  data->qpos[robot.qpos_address[index(Servo::right_hip)]] = -0.3;
  mj_forward(robot.mj.get(), data.get());
  for (const int geom : robot.tyre_geom) {
    EXPECT_NEAR(data->geom_xpos[3 * geom], (0.168 + 0.175) * std::sin(0.3), 1e-12);
  }
}

TEST(Upkie, WithoutMemoryIsNoErrorOfTheEngine) {
  compile_robot_model(upkie_mjcf, Terrain{});  // from then on MuJoCo complains to us
  EXPECT_THROW(mju_error("Could not allocate mjData buffer"), std::bad_alloc);
  EXPECT_THROW(mju_error("mjData has no body"), Error);
}

TEST(Upkie, OnlyCollidesWithTheTerrain) {
  const RobotModel robot = compile_robot_model(upkie_mjcf, Terrain{});
  const MjDataPtr data(mj_makeData(robot.mj.get()));
  data->qpos[2] = 3.0;
  data->qpos[robot.qpos_address[index(Servo::left_hip)]] = 1.2;
  data->qpos[robot.qpos_address[index(Servo::left_knee)]] = -2.5;
  mj_forward(robot.mj.get(), data.get());
  EXPECT_EQ(data->ncon, 0);
}

// ---- against the official description ----

struct Lump {
  double mass = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();   ///< mass times centre of mass
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the frame's origin
};

Eigen::Vector3d triple(const char* text) {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  if (text) std::sscanf(text, "%lf %lf %lf", &v.x(), &v.y(), &v.z());
  return v;
}

Eigen::Isometry3d origin(const tinyxml2::XMLElement* element) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (const auto* tag = element->FirstChildElement("origin")) {
    const Eigen::Vector3d rpy = triple(tag->Attribute("rpy"));
    pose.linear() = (Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()))
                        .toRotationMatrix();
    pose.translation() = triple(tag->Attribute("xyz"));
  }
  return pose;
}

/// Adds `link` and what is fixed to it to `lump`, in the lump's frame; movable children are entered
/// in `roots` with their pose in the world at zero joint angles.
void gather(const tinyxml2::XMLElement* robot, const std::string& link,
            const Eigen::Isometry3d& in_lump, const Eigen::Isometry3d& lump_in_world, Lump& lump,
            std::map<std::string, std::pair<std::string, Eigen::Isometry3d>>& roots) {
  for (auto* tag = robot->FirstChildElement("link"); tag; tag = tag->NextSiblingElement("link")) {
    if (link != tag->Attribute("name")) continue;
    const auto* inertial = tag->FirstChildElement("inertial");
    if (!inertial) continue;
    const double m = inertial->FirstChildElement("mass")->DoubleAttribute("value");
    const auto* i = inertial->FirstChildElement("inertia");
    const auto at = [&](const char* name) { return i->DoubleAttribute(name); };
    Eigen::Matrix3d local;
    local << at("ixx"), at("ixy"), at("ixz"), at("ixy"), at("iyy"), at("iyz"), at("ixz"), at("iyz"),
        at("izz");
    const Eigen::Isometry3d pose = in_lump * origin(inertial);
    const Eigen::Vector3d c = pose.translation();
    lump.mass += m;
    lump.moment += m * c;
    lump.inertia += pose.linear() * local * pose.linear().transpose() +
                    m * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
  }
  for (auto* j = robot->FirstChildElement("joint"); j; j = j->NextSiblingElement("joint")) {
    if (link != j->FirstChildElement("parent")->Attribute("link")) continue;
    const std::string child = j->FirstChildElement("child")->Attribute("link");
    const Eigen::Isometry3d pose = in_lump * origin(j);
    if (std::string(j->Attribute("type")) == "fixed") {
      gather(robot, child, pose, lump_in_world, lump, roots);
    } else {
      roots[j->Attribute("name")] = {child, lump_in_world * pose};
    }
  }
}

TEST(Upkie, AgreesWithTheOfficialDescription) {
  const std::string urdf = TOUCHDOWN_REFERENCE_DATA "/upkie.urdf";
  if (!std::filesystem::exists(urdf)) GTEST_SKIP() << urdf << " is not here";
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.LoadFile(urdf.c_str()), tinyxml2::XML_SUCCESS);
  const auto* description = document.RootElement();

  const RobotModel robot = compile_robot_model(upkie_mjcf, Terrain{});
  const MjDataPtr data(mj_makeData(robot.mj.get()));
  for (int k = 0; k < 3; ++k) data->qpos[k] = 0.0;  // base at the world's origin
  mj_forward(robot.mj.get(), data.get());

  std::map<std::string, std::pair<std::string, Eigen::Isometry3d>> open = {
      {"", {"base", Eigen::Isometry3d::Identity()}}};
  std::set<std::string> seen;
  double mass = 0.0;
  while (!open.empty()) {
    const auto [joint, link] = *open.begin();
    open.erase(open.begin());
    seen.insert(joint);
    Lump lump;
    gather(description, link.first, Eigen::Isometry3d::Identity(), link.second, lump, open);
    mass += lump.mass;

    int body = robot.base_body;
    if (!joint.empty()) {
      const int id = mj_name2id(robot.mj.get(), mjOBJ_JOINT, joint.c_str());
      ASSERT_GE(id, 0) << joint;
      body = robot.mj->jnt_bodyid[id];
    }
    SCOPED_TRACE(joint.empty() ? "base" : joint);
    EXPECT_NEAR(robot.mj->body_mass[body], lump.mass, 1e-6);
    const Eigen::Vector3d centre = lump.moment / lump.mass;
    const Eigen::Vector3d centre_in_world = link.second * centre;
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(data->xipos[3 * body + k], centre_in_world[k], 2e-6);
    }
    const Eigen::Matrix3d about_centre =
        lump.inertia - lump.mass * (centre.squaredNorm() * Eigen::Matrix3d::Identity() -
                                    centre * centre.transpose());
    const Eigen::Matrix3d world =
        link.second.linear() * about_centre * link.second.linear().transpose();
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> frame(data->ximat +
                                                                               9 * body);
    const Eigen::Map<const Eigen::Vector3d> principal(robot.mj->body_inertia + 3 * body);
    const Eigen::Matrix3d ours = frame * principal.asDiagonal() * frame.transpose();
    EXPECT_LT((ours - world).norm(), 1e-3 * world.norm()) << ours << "\n\n" << world;
  }
  EXPECT_EQ(seen.size(), 7u);
  EXPECT_NEAR(total_mass(*robot.mj), mass, 1e-5);
}

}  // namespace
}  // namespace touchdown::models
