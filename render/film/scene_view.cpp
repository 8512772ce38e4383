#include "render/film/scene_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace touchdown::render {
namespace {

/// The distance of the sun's shadow map from the robot (m).
constexpr double sun_distance = 6.0;
constexpr double degree = std::numbers::pi / 180.0;
constexpr float vector_width = 0.012F;                        // m
constexpr float vector_colour[4] = {0.85F, 0.46F, 0.06F, 1};  // of the film's orange labels

}  // namespace

SceneView::SceneView(const models::RobotModel& robot)
    : robot_(robot), data_(mj_makeData(robot.mj.get())) {
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
                     const SceneCamera& camera, std::span<const SceneVector> vectors) {
  const Eigen::Vector3d look_at = target + camera.look_at;
  std::copy_n(look_at.data(), 3, camera_.lookat);
  camera_.azimuth = camera.azimuth;
  camera_.elevation = camera.elevation;
  camera_.distance = camera.distance;
  mjv_updateScene(robot_.mj.get(), data_.get(), &visibility_, nullptr, &camera_, mjCAT_ALL,
                  &scene_);
  place_sun(target);
  switch_haze_on();
  for (const SceneVector& vector : vectors) add(vector);
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

void SceneView::add(const SceneVector& vector) {
  if (scene_.ngeom >= scene_.maxgeom) return;
  mjvGeom& geom = scene_.geoms[scene_.ngeom++];
  mjv_initGeom(&geom, mjGEOM_ARROW, nullptr, nullptr, nullptr, vector_colour);
  const Eigen::Vector3d& a = vector.from;
  const Eigen::Vector3d& b = vector.to;
  mjv_makeConnector(&geom, mjGEOM_ARROW, vector_width, a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
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
