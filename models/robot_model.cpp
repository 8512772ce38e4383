#include "models/robot_model.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <new>
#include <regex>
#include <tinyxml2.h>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "models/resizing.hpp"
#include "models/robot_description.hpp"
#include "models/scene_mjcf.hpp"
#include "models/terrain_mjcf.hpp"

namespace touchdown::models {
namespace {

/// Whether an error message of MuJoCo is about memory.
bool is_about_memory(std::string_view message) {
  return message.find("ould not allocate") != std::string_view::npos;
}

/// Replaces MuJoCo's own handlers, which wait for a key press or write MUJOCO_LOG.TXT into the
/// working directory.
void install_mujoco_handlers() {
  static std::once_flag once;
  std::call_once(once, [] {
    mju_user_error = [](const char* message) {
      if (is_about_memory(message)) throw std::bad_alloc();
      throw Error(std::string("MuJoCo: ") + message);
    };
    mju_user_warning = [](const char*) {};  // a simulator reports divergence as an outcome
  });
}

/// Inserts the scene and the terrain before the end of the robot's text. MuJoCo merges repeated
/// sections, and the robot's lines keep their numbers for error messages.
std::string compose(const std::filesystem::path& robot_mjcf, const Terrain& terrain) {
  const std::string text = read_file(robot_mjcf);
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    const int line = std::max(document.ErrorLineNum(), 1);
    throw InputError(fmt::format("{}:{}:1: expected well-formed XML ({})", robot_mjcf.string(),
                                 line, document.ErrorName()));
  }
  const tinyxml2::XMLElement* root = document.RootElement();
  const std::size_t end = text.rfind("</mujoco");
  if (root == nullptr) {
    throw InputError(
        fmt::format("{}:1:1: expected a robot in <mujoco>...</mujoco>", robot_mjcf.string()));
  }
  if (std::strcmp(root->Name(), "mujoco") != 0 || end == std::string::npos) {
    throw InputError(fmt::format("{}:{}:1: {}: expected a robot in <mujoco>...</mujoco>",
                                 robot_mjcf.string(), root->GetLineNum(), root->Name()));
  }
  return text.substr(0, end) + scene_mjcf + terrain_mjcf(terrain) + text.substr(end);
}

/// Formats an error message of MuJoCo as one line that begins with file:line:column.
std::string located(const std::filesystem::path& robot_mjcf, std::string message) {
  std::smatch match;
  std::string where = robot_mjcf.string();
  if (std::regex_search(message, match, std::regex("line (\\d+), column (\\d+)"))) {
    where += ":" + match[1].str() + ":" + match[2].str();
  } else if (std::regex_search(message, match, std::regex("line[ =]+(-?\\d+)"))) {
    where += ":" + match[1].str() + ":1";
  }
  std::replace(message.begin(), message.end(), '\n', ' ');
  while (!message.empty() && message.back() == ' ') message.pop_back();
  return where + ": " + message;
}

MjModelPtr compile(const std::filesystem::path& robot_mjcf, const std::string& mjcf) {
  // The name is in the folder of the robot's file, so that meshes and includes are found there.
  const char* const file_name = "touchdown_composed.xml";
  const auto release = [](mjVFS* vfs) {
    mj_deleteVFS(vfs);
    delete vfs;
  };
  std::unique_ptr<mjVFS, decltype(release)> vfs(new mjVFS, release);
  mj_defaultVFS(vfs.get());
  if (mj_makeEmptyFileVFS(vfs.get(), file_name, static_cast<int>(mjcf.size())) != 0) {
    throw Error("MuJoCo has no room for the composed model");
  }
  const int slot = mj_findFileVFS(vfs.get(), file_name);
  std::memcpy(vfs->filedata[slot], mjcf.data(), mjcf.size());

  std::array<char, 1000> message = {};
  const std::string beside = (robot_mjcf.parent_path() / file_name).string();
  MjModelPtr model(
      mj_loadXML(beside.c_str(), vfs.get(), message.data(), static_cast<int>(message.size())));
  if (!model && is_about_memory(message.data())) throw std::bad_alloc();
  if (!model) throw InputError(located(robot_mjcf, message.data()));
  return model;
}

/// Looks up the names of the naming contract and reports missing ones.
class Contract {
 public:
  Contract(const std::filesystem::path& file, const mjModel& model) : file_(file), model_(model) {}

  int find(mjtObj type, std::string_view kind, std::string_view name) const {
    const int id = mj_name2id(&model_, type, std::string(name).c_str());
    if (id < 0) fail(fmt::format("expected a {} named '{}'", kind, name));
    return id;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(file_.string() + ": " + message);
  }

 private:
  const std::filesystem::path& file_;
  const mjModel& model_;
};

/// Finds the floating base body, the root of the robot.
int find_base(const mjModel& model, const Contract& contract) {
  int base = -1;
  for (int joint = 0; joint < model.njnt; ++joint) {
    if (model.jnt_type[joint] != mjJNT_FREE) continue;
    if (base >= 0) contract.fail("expected one free joint, found several");
    base = model.jnt_bodyid[joint];
  }
  if (base < 0) contract.fail("expected a base body with a <freejoint/>");
  return base;
}

void find_servos(RobotModel& robot, const Contract& contract) {
  const mjModel& model = *robot.mj;
  if (model.njnt != servo_count + 1) {
    contract.fail(fmt::format("expected {} hinge joints and a free joint, found {} joints",
                              servo_count, model.njnt));
  }
  for (std::size_t i = 0; i < servo_count; ++i) {
    const std::string name(servo_names[i]);
    const int joint = contract.find(mjOBJ_JOINT, "hinge joint", name);
    if (model.jnt_type[joint] != mjJNT_HINGE) {
      contract.fail(fmt::format("joint '{}': expected a hinge", name));
    }
    const int motor = contract.find(mjOBJ_ACTUATOR, "motor", name);
    if (model.actuator_trntype[motor] != mjTRN_JOINT || model.actuator_trnid[2 * motor] != joint) {
      contract.fail(fmt::format("motor '{0}': expected it to drive joint '{0}'", name));
    }
    if (!model.actuator_ctrllimited[motor]) {
      contract.fail(fmt::format("motor '{}': expected a ctrlrange, its torque limit (N·m)", name));
    }
    robot.qpos_address[i] = model.jnt_qposadr[joint];
    robot.dof_address[i] = model.jnt_dofadr[joint];
    robot.effort[i] = model.actuator_ctrlrange[2 * motor + 1];
    robot.actuator[i] = {.friction = model.dof_frictionloss[robot.dof_address[i]],
                         .viscous = model.dof_damping[robot.dof_address[i]],
                         .armature = model.dof_armature[robot.dof_address[i]]};
  }
}

/// Sets the actuators of the robot's file in the model. MuJoCo simulates the rotor inertia; the
/// simulators add everything else (simulators/actuators.hpp).
void set_actuators(RobotModel& robot, const RobotDescription& description) {
  for (std::size_t i = 0; i < servo_count; ++i) {
    if (const auto& given = description.actuator(static_cast<Servo>(i))) robot.actuator[i] = *given;
    const int dof = robot.dof_address[i];
    robot.effort[i] = std::min(robot.effort[i], robot.actuator[i].maximum_torque);
    robot.mj->dof_armature[dof] = robot.actuator[i].armature;
    robot.mj->dof_damping[dof] = 0.0;
    robot.mj->dof_frictionloss[dof] = 0.0;
  }
  if (std::any_of(robot.actuator.begin(), robot.actuator.end(),
                  [](const Actuator& actuator) { return actuator.armature != 0.0; })) {
    recompute(*robot.mj);
  }
}

/// Sets the size that the robot's file specifies.
void set_size(RobotModel& robot, const RobotDescription& description, const Contract& contract) {
  const double wheels = description.wheel_radius.value_or(robot.wheel_radius) / robot.wheel_radius;
  bool changed = description.mass != 1.0 || wheels != 1.0;
  if (description.mass != 1.0) scale_mass(*robot.mj, description.mass);
  if (wheels != 1.0) {
    scale_wheels(*robot.mj, wheels);
    robot.wheel_radius *= wheels;
  }
  for (std::size_t leg = 0; leg < description.legs.one.size(); ++leg) {
    const double length = description.legs.both * description.legs.one[leg];
    if (length == 1.0) continue;
    try {
      scale_leg(*robot.mj, leg, length);
    } catch (const InputError& error) {
      contract.fail(error.what());
    }
    changed = true;
  }
  if (changed) recompute(*robot.mj);
}

constexpr std::array<const char*, wheel_count> tyre_names = {"left_tire", "right_tire"};

std::string strip_name(std::size_t wheel, std::size_t strip) {
  return fmt::format("touchdown_{}_{}", tyre_names[wheel], strip);
}

void find_tyres(RobotModel& robot, const Contract& contract) {
  const mjModel& model = *robot.mj;
  for (std::size_t i = 0; i < wheel_count; ++i) {
    const std::string name = tyre_names[i];
    const std::string servo(servo_names[index(wheel_servos[i])]);
    const int geom = contract.find(mjOBJ_GEOM, "geom", name);
    const int joint = mj_name2id(&model, mjOBJ_JOINT, servo.c_str());
    if (model.geom_bodyid[geom] != model.jnt_bodyid[joint]) {
      contract.fail(fmt::format("geom '{}': expected it on the body that '{}' moves", name, servo));
    }
    const int type = model.geom_type[geom];
    if (type != mjGEOM_SPHERE && type != mjGEOM_CYLINDER && type != mjGEOM_CAPSULE) {
      contract.fail(fmt::format("geom '{}': expected a sphere, a cylinder or a capsule", name));
    }
    robot.tyre_geom[i] = geom;
    robot.tyre_strips[i] = {geom};
    robot.wheel_radius = model.geom_size[3 * geom];
  }
}

/// Adds the spheres of the tyres' strips to the MJCF, on the lines of the tyre geoms, so that line
/// numbers stay. `robot` is compiled from this MJCF.
std::string with_strips(std::string mjcf, const RobotModel& robot,
                        const std::filesystem::path& file) {
  const mjModel& model = *robot.mj;
  const Contract contract(file, model);
  const std::vector<double> strips = robot.tyre.strips();
  for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
    const int tyre = robot.tyre_geom[wheel];
    if (model.geom_type[tyre] != mjGEOM_SPHERE) {
      contract.fail(
          fmt::format("geom '{}': expected a sphere, as the tyre has a width", tyre_names[wheel]));
    }
    std::smatch element;
    const std::regex name(fmt::format("<geom\\s[^>]*name\\s*=\\s*[\"']{}[\"']", tyre_names[wheel]));
    if (!std::regex_search(mjcf, element, name)) {
      contract.fail(fmt::format("expected geom '{}' in this file itself, as the tyre has a width",
                                tyre_names[wheel]));
    }
    const Eigen::Vector3d middle = vector_at(model.geom_pos, tyre);
    const int dof = robot.dof_address[index(wheel_servos[wheel])];
    const Eigen::Vector3d axle = vector_at(model.jnt_axis, model.dof_jntid[dof]);
    std::string spheres;
    for (std::size_t strip = 1; strip < strips.size(); ++strip) {
      const Eigen::Vector3d at = middle + strips[strip] * axle;
      spheres += fmt::format(
          "<geom name=\"{}\" type=\"sphere\" size=\"{}\" pos=\"{} {} {}\" mass=\"0\" group=\"{}\" "
          "contype=\"{}\" conaffinity=\"{}\" condim=\"{}\" margin=\"0\" gap=\"0\" priority=\"0\"/>",
          strip_name(wheel, strip), model.geom_size[3 * tyre], at.x(), at.y(), at.z(),
          model.geom_group[tyre], model.geom_contype[tyre], model.geom_conaffinity[tyre],
          model.geom_condim[tyre]);
    }
    mjcf.insert(static_cast<std::size_t>(element.position()), spheres);
  }
  return mjcf;
}

void find_strips(RobotModel& robot, const Contract& contract) {
  for (std::size_t wheel = 0; wheel < wheel_count; ++wheel) {
    for (std::size_t strip = 1; strip < robot.tyre.strips().size(); ++strip) {
      robot.tyre_strips[wheel].push_back(
          contract.find(mjOBJ_GEOM, "geom", strip_name(wheel, strip)));
    }
  }
}

/// Compiles the MJCF (that of `description` with a terrain) and looks up the robot's parts in it.
RobotModel compile(const RobotDescription& description, const std::string& mjcf) {
  RobotModel robot;
  robot.mj = compile(description.mjcf, mjcf);
  robot.tyre = description.tyre;
  const Contract contract(description.mjcf, *robot.mj);
  robot.name = robot.mj->names;  // the model's own name comes first
  robot.base_body = find_base(*robot.mj, contract);
  find_servos(robot, contract);
  set_actuators(robot, description);
  robot.imu_site = contract.find(mjOBJ_SITE, "site", "imu");
  if (robot.mj->site_bodyid[robot.imu_site] != robot.base_body) {
    contract.fail("site 'imu': expected it on the base body");
  }
  find_tyres(robot, contract);
  set_size(robot, description, contract);
  return robot;
}

}  // namespace

RobotModel compile_robot_model(const std::filesystem::path& robot_file, const Terrain& terrain) {
  install_mujoco_handlers();
  const RobotDescription description = robot_description(robot_file);
  std::string mjcf = compose(description.mjcf, terrain);
  const bool has_strips = description.tyre.strips().size() > 1;
  if (has_strips) {
    // Strips are added at the MJCF's original size; the description then scales them, too.
    RobotDescription as_drawn = description;
    as_drawn.wheel_radius.reset();
    as_drawn.legs = {};
    mjcf = with_strips(mjcf, compile(as_drawn, mjcf), description.mjcf);
  }
  RobotModel robot = compile(description, mjcf);
  if (has_strips) find_strips(robot, Contract(description.mjcf, *robot.mj));
  return robot;
}

void write_pose(const RobotModel& robot, const Eigen::Vector3d& position,
                const Eigen::Quaterniond& orientation,
                const std::array<double, servo_count>& joint_position, mjtNum* qpos) {
  mjtNum* const base = qpos + robot.base_qpos();
  std::copy_n(position.data(), 3, base);
  base[3] = orientation.w();
  base[4] = orientation.x();
  base[5] = orientation.y();
  base[6] = orientation.z();
  for (std::size_t i = 0; i < servo_count; ++i) qpos[robot.qpos_address[i]] = joint_position[i];
}

MjDataPtr at_zero(const RobotModel& robot) {
  MjDataPtr data(mj_makeData(robot.mj.get()));
  if (!data) throw Error("MuJoCo could not make its data: out of memory");
  write_pose(robot, Eigen::Vector3d::Zero(), Eigen::Quaterniond::Identity(), {}, data->qpos);
  mj_kinematics(robot.mj.get(), data.get());
  return data;
}

}  // namespace touchdown::models
