#include "render/film/scene_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace touchdown::render {

namespace {

/// The wheels' mean path since the first row, without slip (m).
std::vector<Eigen::Vector3d> odometry(const models::RobotModel& robot,
                                      const logs::Recording& recording) {
  std::vector<Eigen::Vector3d> path(recording.steps(), Eigen::Vector3d::Zero());
  const auto forward = [](const models::Observation& observation) {
    return 0.5 * (observation.servo[models::index(models::Servo::left_wheel)].position -
                  observation.servo[models::index(models::Servo::right_wheel)].position);
  };
  for (std::size_t k = 1; k < path.size(); ++k) {
    const models::Observation& now = recording.observation[k];
    const double step = robot.wheel_radius * (forward(now) - forward(recording.observation[k - 1]));
    path[k] = path[k - 1] + step * Eigen::Vector3d(std::cos(now.yaw), std::sin(now.yaw), 0.0);
    if (!path[k].allFinite()) path[k] = path[k - 1];
  }
  return path;
}

Eigen::Quaterniond finite_or_upright(const Eigen::Quaterniond& orientation) {
  const bool good = orientation.coeffs().allFinite() && orientation.norm() > 0.5;
  return good ? orientation.normalized() : Eigen::Quaterniond::Identity();
}

std::vector<double> held_positions(const models::GroundTruth& truth) {
  std::vector<double> positions;
  for (const models::ServoReading& held : truth.held) positions.push_back(held.position);
  return positions;
}

/// The distance of the sun's shadow map from the robot (m).
constexpr double sun_distance = 6.0;
constexpr double degree = std::numbers::pi / 180.0;
constexpr double usual_reach = 0.65;    // m: of a robot that cameras are made for
constexpr double vector_width = 0.012;  // m
constexpr double rod_radius = 0.012;    // m: as of bodies without a shape
constexpr double loop_radius = 0.0115;  // m: within a rod along it, of another colour
constexpr float rod_colour[4] = {0.5F, 0.5F, 0.5F, 1};
constexpr float vector_colour[4] = {0.85F, 0.46F, 0.06F, 1};  // of the film's orange labels

}  // namespace

Poses::Poses(const models::RobotModel& robot, const logs::Recording& recording)
    : robot_(robot), recording_(recording) {
  if (recording.steps() == 0) throw InputError("the recording is empty: there is nothing to draw");
  if (recording.truth.size() < recording.steps()) {
    base_ = odometry(robot, recording);
    const models::MjDataPtr data(mj_makeData(robot.mj.get()));
    if (!data) throw Error("MuJoCo has no memory for another model");
    for (std::size_t row = 0; row < base_.size(); ++row) {
      write(row, *data);
      mj_kinematics(robot.mj.get(), data.get());
      double lowest = data->geom_xpos[3 * robot.tyre_geom[0] + 2];
      for (const int geom : robot.tyre_geom) {
        lowest = std::min(lowest, data->geom_xpos[3 * geom + 2]);
      }
      base_[row].z() += robot.wheel_radius - lowest;
    }
    return;
  }
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  base_.reserve(recording.steps());
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    const Eigen::Vector3d& position = recording.truth[k].base_position;
    // A diverged run ends in numbers that cannot be drawn.
    if (position.allFinite() && position.norm() < 1e4) last = position;
    base_.push_back(last);
  }
}

void Poses::apply(std::size_t row, mjData& data) const {
  write(row, data);
  update_geoms(*robot_.mj, data);
}

void Poses::write(std::size_t row, mjData& data) const {
  const models::Observation& observation = recording_.observation[row];
  const bool simulated = recording_.truth.size() >= recording_.steps();
  const Eigen::Quaterniond orientation = finite_or_upright(
      simulated ? recording_.truth[row].base_orientation
                : Eigen::AngleAxisd(observation.yaw, Eigen::Vector3d::UnitZ()) *
                      Eigen::AngleAxisd(observation.pitch, Eigen::Vector3d::UnitY()));
  std::array<double, models::servo_count> joints;
  for (std::size_t i = 0; i < models::servo_count; ++i) {
    const double angle = observation.servo[i].position;
    joints[i] = std::isfinite(angle) ? angle : 0.0;
  }
  models::write_pose(robot_, base_[row], orientation, joints, data.qpos);
  const std::vector<double> held =
      simulated ? held_positions(recording_.truth[row]) : std::vector<double>();
  models::write_held(robot_, held, data.qpos);
}

double elevation_above_ground(const models::RobotModel& robot, const mjData& data,
                              const SceneCamera& camera, const Eigen::Vector3d& target) {
  constexpr double clearance = 0.1;  // m
  constexpr double steepest = -89.0;
  constexpr double step = 0.5;    // degrees
  constexpr double above = 50.0;  // m: where a ray to the ground starts
  double elevation = camera.elevation;
  for (; elevation > steepest; elevation -= step) {
    const double flat = camera.distance * std::cos(elevation * degree);
    const Eigen::Vector3d eye = target + camera.look_at -
                                Eigen::Vector3d(flat * std::cos(camera.azimuth * degree),
                                                flat * std::sin(camera.azimuth * degree),
                                                camera.distance * std::sin(elevation * degree));
    const Eigen::Vector3d start = eye + Eigen::Vector3d(0.0, 0.0, above);
    const Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();
    int geom = -1;
    const double depth = mj_ray(robot.mj.get(), &data, start.data(), down.data(), nullptr, 1,
                                robot.base_body, &geom);
    if (depth < 0.0 || robot.mj->geom_bodyid[geom] != 0 || depth > above + clearance) break;
  }
  return elevation;
}

void update_geoms(const mjModel& model, mjData& data) {
  mj_kinematics(&model, &data);
  mj_comPos(&model, &data);
  mj_camlight(&model, &data);
}

std::vector<Eigen::Vector3d> smoothed(std::vector<Eigen::Vector3d> values, double period,
                                      double time_constant) {
  const double gain = 1.0 - std::exp(-period / time_constant);
  for (std::size_t k = 1; k < values.size(); ++k) {
    values[k] = values[k - 1] + gain * (values[k] - values[k - 1]);
  }
  for (std::size_t k = values.size(); k-- > 1;) {
    values[k - 1] = values[k] + gain * (values[k - 1] - values[k]);
  }
  return values;
}

/// Rods from the frames of bodies without a shape of their own to where their loops meet. The rods
/// that models/mjcf/assets.cpp draws in such bodies end at joints alone.
static std::vector<SceneVector> rods_of_loops(const mjModel& model, const mjData& data) {
  const auto has_shape = [&](int body) {
    for (int i = 0; i < model.body_geomnum[body]; ++i) {
      const int geom = model.body_geomadr[body] + i;
      const bool is_drawn = model.geom_group[geom] < mjNGROUP / 2;
      const bool is_rod = model.geom_size[3 * geom] == rod_radius && model.geom_matid[geom] < 0 &&
                          std::equal(rod_colour, rod_colour + 4, &model.geom_rgba[4 * geom]);
      if (is_drawn && !is_rod) return true;
    }
    return false;
  };
  std::vector<SceneVector> rods;
  for (int loop = 0; loop < model.neq; ++loop) {
    for (int end = 0; end < 2; ++end) {
      const int body = end == 0 ? model.eq_obj1id[loop] : model.eq_obj2id[loop];
      if (has_shape(body)) continue;
      const Eigen::Vector3d from = models::vector_at(data.xpos, body);
      const Eigen::Vector3d anchor = models::vector_at(model.eq_data + mjNEQDATA * loop, end);
      rods.push_back({from, from + models::quaternion_at(data.xquat, body) * anchor});
    }
  }
  return rods;
}

/// The largest distance of a part of the robot from its base (m), at the pose of its file.
static double reach_of(const models::RobotModel& robot) {
  const models::MjDataPtr data = models::at_reference(robot);
  update_geoms(*robot.mj, *data);
  const Eigen::Vector3d base = models::vector_at(data->xpos, robot.base_body);
  double reach = 0.0;
  for (int geom = 0; geom < robot.mj->ngeom; ++geom) {
    if (robot.mj->geom_bodyid[geom] == 0) continue;
    const Eigen::Vector3d centre = models::vector_at(data->geom_xpos, geom);
    reach = std::max(reach, (centre - base).norm() + robot.mj->geom_rbound[geom]);
  }
  return reach;
}

SceneView::SceneView(const models::RobotModel& robot)
    : robot_(robot),
      data_(mj_makeData(robot.mj.get())),
      scale_(std::max(1.0, reach_of(robot) / usual_reach)) {
  const mjModel* model = robot.mj.get();
  mjv_defaultScene(&scene_);
  mjv_defaultOption(&visibility_);
  mjv_defaultCamera(&camera_);
  mjr_defaultContext(&context_);
  if (!data_) throw Error("MuJoCo has no memory for another model");
  try {
    mjv_makeScene(model, &scene_, model->ngeom + 64);
    mjr_makeContext(model, &context_, mjFONTSCALE_100);
  } catch (...) {
    mjv_freeScene(&scene_);
    throw;
  }
  mjr_setBuffer(mjFB_WINDOW, &context_);
  std::fill(std::begin(visibility_.sitegroup), std::end(visibility_.sitegroup), mjtByte{0});
  camera_.type = mjCAMERA_FREE;
  scene_.flags[mjRND_HAZE] = 1;
  scene_.flags[mjRND_SHADOW] = 1;
}

SceneView::~SceneView() {
  mjr_freeContext(&context_);
  mjv_freeScene(&scene_);
}

void SceneView::draw(const mjrRect& viewport, const Eigen::Vector3d& target,
                     const SceneCamera& wanted, std::span<const SceneVector> vectors) {
  SceneCamera camera = wanted;
  camera.distance *= scale_;
  camera.look_at *= scale_;
  const Eigen::Vector3d look_at = target + camera.look_at;
  std::copy_n(look_at.data(), 3, camera_.lookat);
  camera_.azimuth = camera.azimuth;
  camera_.distance = camera.distance;
  camera_.elevation = elevation_above_ground(robot_, *data_, camera, target);
  mjv_updateScene(robot_.mj.get(), data_.get(), &visibility_, nullptr, &camera_, mjCAT_ALL,
                  &scene_);
  place_sun(target);
  switch_haze_on();
  for (const SceneVector& rod : rods_of_loops(*robot_.mj, *data_)) {
    add(rod, mjGEOM_CAPSULE, loop_radius, rod_colour);
  }
  for (const SceneVector& vector : vectors) add(vector, mjGEOM_ARROW, vector_width, vector_colour);
  mjr_render(viewport, &scene_, &context_);
}

std::optional<Eigen::Vector3d> SceneView::robot_at(const mjrRect& viewport, double x,
                                                   double y) const {
  Eigen::Vector3d point;
  int geom = -1;
  int skin = -1;
  const int body = mjv_select(robot_.mj.get(), data_.get(), &visibility_,
                              static_cast<double>(viewport.width) / std::max(1, viewport.height), x,
                              y, &scene_, point.data(), &geom, &skin);
  if (body <= 0) return std::nullopt;  // body 0 is the world
  return point;
}

Eigen::Vector3d SceneView::motion_of(const mjrRect& viewport, const Eigen::Vector3d& point,
                                     const Eigen::Vector2d& pixels) const {
  const mjvGLCamera& eye = scene_.camera[0];
  const Eigen::Vector3d forward = Eigen::Map<const Eigen::Vector3f>(eye.forward).cast<double>();
  const Eigen::Vector3d up = Eigen::Map<const Eigen::Vector3f>(eye.up).cast<double>();
  const Eigen::Vector3d position = Eigen::Map<const Eigen::Vector3f>(eye.pos).cast<double>();
  const double depth = std::max(0.1, (point - position).dot(forward));
  const double height = 2.0 * depth * std::tan(0.5 * degree * robot_.mj->vis.global.fovy);
  const double metres = height / std::max(1, viewport.height);
  return metres * (pixels.x() * forward.cross(up) + pixels.y() * up);
}

void SceneView::copy(const std::uint8_t* pixels, const mjrRect& area) const {
  mjr_drawPixels(pixels, nullptr, area, &context_);
}

void SceneView::add(const SceneVector& vector, mjtGeom shape, double width, const float* colour) {
  if (scene_.ngeom >= scene_.maxgeom) return;
  mjvGeom& geom = scene_.geoms[scene_.ngeom++];
  mjv_initGeom(&geom, shape, nullptr, nullptr, nullptr, colour);
  const Eigen::Vector3d& a = vector.from;
  const Eigen::Vector3d& b = vector.to;
  mjv_makeConnector(&geom, shape, width, a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
  geom.category = mjCAT_DECOR;
}

/// The shadow map covers a box around the sun's axis, so the axis goes through the robot. It moves
/// by whole texels of the map, so that shadow edges do not flicker.
void SceneView::place_sun(const Eigen::Vector3d& target) {
  const mjModel& model = *robot_.mj;
  const double texel = 2.0 * model.vis.map.shadowclip * model.stat.extent /
                       std::max(1, model.vis.quality.shadowsize);
  for (int i = 0; i < scene_.nlight; ++i) {
    mjvLight& light = scene_.lights[i];
    if (!light.directional || !light.castshadow) continue;
    const Eigen::Vector3d axis =
        Eigen::Map<const Eigen::Vector3f>(light.dir).cast<double>().normalized();
    const Eigen::Vector3d u = axis.cross(Eigen::Vector3d::UnitY()).normalized();
    const Eigen::Vector3d v = axis.cross(u);
    const Eigen::Vector3d at = target - sun_distance * axis;
    const Eigen::Vector3d snapped = std::round(at.dot(u) / texel) * texel * u +
                                    std::round(at.dot(v) / texel) * texel * v + at.dot(axis) * axis;
    Eigen::Map<Eigen::Vector3f>(light.pos) = snapped.cast<float>();
  }
}

/// The renderer draws haze only if the scene has an infinite plane. This plane is itself invisible.
void SceneView::switch_haze_on() {
  if (scene_.ngeom >= scene_.maxgeom) return;
  mjvGeom& plane = scene_.geoms[scene_.ngeom++];
  const mjtNum size[3] = {0, 0, 0};
  const float colour[4] = {1, 1, 1, 1};
  mjv_initGeom(&plane, mjGEOM_PLANE, size, nullptr, nullptr, colour);
  plane.dataid = -1;
  plane.category = mjCAT_DECOR;
}

}  // namespace touchdown::render
