#include "models/robot_draft.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <Eigen/Core>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/yaml.h>

#include "core/error.hpp"
#include "models/robot_source.hpp"

namespace touchdown::models {

namespace {

using Eigen::Vector3d;

class Draft {
 public:
  explicit Draft(const std::filesystem::path& file)
      : description_(robot_description(file)),
        keys_(file),
        file_(robot_file(description_, keys_)),
        model_(compile(file_, Terrain{})) {
    data_ = make_data(*model_);
    mj_kinematics(model_.get(), data_.get());
    for (int joint = 0; joint < model_->njnt; ++joint) {
      if (model_->jnt_type[joint] == mjJNT_FREE) base_ = model_->jnt_bodyid[joint];
    }
    try {
      legs_ = find_legs(*model_, *data_, base_);
    } catch (const InputError& error) {
      source().fail(error.what());
    }
  }

  std::vector<DraftLine> lines() {
    for (const std::string& warning : file_.warnings) add("", "", warning);
    add_base();
    add_joints();
    add_held();
    add_tyres();
    add_imu();
    add_limits();
    add("balancer", "{gains: lqr}");
    return std::move(lines_);
  }

 private:
  void add(std::string key, std::string value, std::string comment = {}) {
    lines_.push_back({std::move(key), std::move(value), std::move(comment)});
  }

  std::string name(mjtObj type, int id) const { return name_of(*model_, type, id); }
  RobotSource source() const { return {file_, description_, keys_, *model_}; }

  /// The name by which the YAML file knows a joint.
  std::string joint_name(int joint) const {
    std::string text = name(mjOBJ_JOINT, joint);
    if (text.empty())
      source().fail_at_hinge(joint, "expected a name, by which a YAML file knows it");
    return text;
  }
  Vector3d anchor(int joint) const { return vector_at(data_->xanchor, joint); }

  void add_base() {
    if (std::string_view(file_.document.file().extension().string()) == ".urdf") {
      add("base", as_yaml(name(mjOBJ_BODY, base_)));
    }
    const Vector3d left = anchor(legs_.axle[0].joint) - anchor(legs_.axle[1].joint);
    if (legs_.has_sides && std::abs(left.y()) > std::abs(left.x()) && left.y() < 0.0) {
      add("forward", "-x", "the left leg is at smaller y");
    } else if (!legs_.has_sides) {
      add("", "", "Names do not distinguish left from right: left is taken as the larger y.");
    }
  }

  void add_joints() {
    std::string joints;
    for (std::size_t side = 0; side < wheel_count; ++side) {
      const std::string of = side == 0 ? "left" : "right";
      const std::vector<int>& pitch = legs_.pitch[side];
      if (pitch.size() == 2)
        joints += fmt::format("\n  {}_hip: {}", of, as_yaml(joint_name(pitch[0])));
      joints +=
          fmt::format("\n  {}_knee: {}\n  {}_wheel: {}", of, as_yaml(joint_name(pitch.back())), of,
                      as_yaml(joint_name(legs_.axle[side].joint)));
    }
    add("joints", joints);
    if (legs_.pitch[0].size() == 1) add("hip", "none");
  }

  /// The joints that loops move: neither servos nor held.
  std::set<int> linked() const {
    std::set<int> joints;
    for (int loop = 0; loop < model_->neq; ++loop) {
      for (int body : {model_->eq_obj1id[loop], model_->eq_obj2id[loop]}) {
        for (; body != base_ && body > 0; body = model_->body_parentid[body]) {
          for (int i = 0; i < model_->body_jntnum[body]; ++i) {
            joints.insert(model_->body_jntadr[body] + i);
          }
        }
      }
    }
    return joints;
  }

  std::vector<std::string> names_of(const std::vector<int>& joints) const {
    std::vector<std::string> names;
    for (const int joint : joints) names.push_back(as_yaml(joint_name(joint)));
    return names;
  }

  void add_held() {
    const std::set<int> in_loops = linked();
    JointsOfLegs legs = legs_.pitch;
    for (std::size_t i = 0; i < wheel_count; ++i) legs[i].push_back(legs_.axle[i].joint);
    std::vector<int> rods;
    for (int joint = 0; joint < model_->njnt; ++joint) {
      const bool is_servo =
          std::ranges::count(legs[0], joint) + std::ranges::count(legs[1], joint) > 0;
      if (model_->jnt_type[joint] == mjJNT_FREE || is_servo || in_loops.contains(joint)) continue;
      (is_rod(*model_, *data_, legs, joint) ? rods : held_).push_back(joint);
    }
    if (!held_.empty()) {
      add("held", fmt::format("[{}]", fmt::join(names_of(held_), ", ")),
          "all that no wheel needs to balance");
    }
    if (rods.empty()) return;
    add("", "",
        fmt::format("{}: rods or cranks of loops that the file cuts open? Where loops meet, and "
                    "which joints have motors, is for you to give:",
                    fmt::join(names_of(rods), ", ")));
    add("", "",
        fmt::format("loops: [{{bodies: [{}, …], anchor: [x, y, z]}}, …], motors: {{left: […], "
                    "right: […]}}",
                    as_yaml(name(mjOBJ_BODY, model_->jnt_bodyid[rods.front()]))));
  }

  void add_tyres() {
    const Axle& left = legs_.axle[0];
    const auto add_radius = [&](double radius, const char* source) {
      add("tyres", fmt::format("{{radius: {:.4g}}}", radius), source);
    };
    if (!left.tyre.empty() && !legs_.axle[1].tyre.empty()) {
      return add("tyres", fmt::format("{{left: {}, right: {}}}", as_yaml(left.tyre),
                                      as_yaml(legs_.axle[1].tyre)));
    }
    // One wheel may lack its mesh.
    const Axle& measured = left.radius > 0.0 ? left : legs_.axle[1];
    if (measured.radius > 0.0) {
      return add_radius(measured.radius,
                        measured.is_mesh ? "m, of the wheel's mesh" : "m, of a wheel's round geom");
    }
    const int body = model_->jnt_bodyid[left.joint];
    double aside = 0.0;
    for (int geom = 0; geom < model_->ngeom; ++geom) {
      if (model_->geom_bodyid[geom] != body || model_->geom_type[geom] == mjGEOM_BOX) continue;
      const bool is_mesh = model_->geom_type[geom] == mjGEOM_MESH;
      aside = std::max(aside, is_mesh ? model_->geom_rbound[geom] : model_->geom_size[3 * geom]);
    }
    if (aside > 0.0) {
      return add_radius(aside, "m, a guess: the wheel's shape is not round about its axle");
    }
    const mjtNum* const inertia = &model_->body_inertia[3 * body];
    const auto [least, most] = std::minmax_element(inertia, inertia + 3);
    constexpr double flat = 1.3;  // a disc has 2, a ball 1
    if (*most < flat * *least) {
      return add("", "",
                 "tyres: {radius: …}  # m; neither shape nor inertia of the wheels give it");
    }
    // A disc: I = m r²/2.
    add_radius(std::sqrt(2.0 * *most / model_->body_mass[body]),
               "m, a guess from the wheel's inertia: its shape is missing");
  }

  bool is_on_base(int body) const {
    return model_->body_weldid[body] == model_->body_weldid[base_];
  }

  /// The shortest name with one of these parts; empty if there is none.
  std::string sensor(mjtObj type, int count, const int* body) const {
    std::string best;
    for (const char* part : {"imu", "gyro", "accel"}) {
      for (int i = 0; i < count; ++i) {
        const std::string text = name(type, i);
        const bool fits = has_part(text, part) && is_on_base(body == nullptr ? i : body[i]);
        if (fits && (best.empty() || text.size() < best.size())) best = text;
      }
      if (!best.empty()) return best;
    }
    return best;
  }

  void add_imu() {
    std::string imu = sensor(mjOBJ_SITE, model_->nsite, model_->site_bodyid);
    if (imu.empty()) imu = sensor(mjOBJ_BODY, model_->nbody, nullptr);
    if (!imu.empty()) return add("imu", as_yaml(imu));
    add("imu", as_yaml(name(mjOBJ_BODY, base_)), "a guess: nothing on the base is called an IMU");
  }

  bool has_limit(int joint) const {
    const int motor = source().motor_of(joint);
    return std::isfinite(source().limit_of(joint)) ||
           (motor >= 0 && (model_->actuator_ctrllimited[motor] != 0 ||
                           model_->actuator_forcelimited[motor] != 0));
  }

  /// Torque limits from the robot's weight, if its file has none. A servo without a limit beside
  /// others with one has no motor, and `check` reports it. What is held is held by a guess anyway.
  void add_limits() {
    const std::vector<int>& pitch = legs_.pitch[0];
    const int wheel = legs_.axle[0].joint;
    const double length = (anchor(pitch.front()) - anchor(wheel)).norm();
    const double weight = 9.81 * model_->body_subtreemass[base_];
    if (!std::ranges::all_of(held_, [&](int joint) { return has_limit(joint); })) {
      add("held_servo", fmt::format("{{maximum_torque: {:.2g}}}", weight * length),
          "N·m, guessed from the weight: give your own");
    }
    if (has_limit(wheel) ||
        std::any_of(pitch.begin(), pitch.end(), [&](int joint) { return has_limit(joint); })) {
      return;
    }
    std::string limits;
    const auto add_limit = [&](const char* what, int joint, double torque) {
      const int dof = model_->jnt_dofadr[joint];
      limits += fmt::format(
          "\n  {}: {{maximum_torque: {:.2g}, armature: {:g}, friction: {:g}, viscous: {:g}}}", what,
          torque, model_->dof_armature[dof], model_->dof_frictionloss[dof],
          model_->dof_damping[dof]);
    };
    if (pitch.size() == 2) add_limit("hip", pitch[0], weight * length);
    add_limit("knee", pitch.back(), weight * length);
    add_limit("wheel", wheel, weight * std::max(0.03, 0.5 * legs_.axle[0].radius));
    add("actuators", limits, "torques guessed from the weight: give your own");
  }

  RobotDescription description_;
  RobotKeys keys_;
  RobotFile file_;
  MjModelPtr model_;
  MjDataPtr data_;
  int base_ = -1;
  FoundLegs legs_;
  std::vector<int> held_;
  std::vector<DraftLine> lines_;
};

}  // namespace

std::string as_yaml(const std::string& name) {
  YAML::Emitter list;
  list << YAML::Flow << YAML::BeginSeq << name << YAML::EndSeq;
  return {list.c_str() + 1, list.size() - 2};
}

std::vector<DraftLine> drafted_robot(const std::filesystem::path& robot) {
  return Draft(robot).lines();
}

std::string text_of(const std::vector<DraftLine>& draft, const std::string& robot) {
  std::string text = fmt::format("mjcf: {}\n", robot);
  for (const DraftLine& line : draft) {
    const std::string comment = line.comment.empty() ? "" : "# " + line.comment;
    if (line.value.empty()) {
      text += comment + "\n";
    } else if (line.value.front() == '\n') {
      text +=
          fmt::format("{}:{}{}{}\n", line.key, comment.empty() ? "" : "  ", comment, line.value);
    } else {
      text +=
          fmt::format("{}: {}{}{}\n", line.key, line.value, comment.empty() ? "" : "  ", comment);
    }
  }
  return text;
}

}  // namespace touchdown::models
