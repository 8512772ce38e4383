#include "render/film/scene_view.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace touchdown::render {
namespace {

/// The distance of the sun's shadow map from the robot (m).
constexpr double sun_distance = 6.0;
/// The offset of the camera's target from the base, in the world (m).
const Eigen::Vector3d look_at_offset = {0.12, 0.0, -0.28};

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
  camera_.azimuth = 128.0;    // degrees
  camera_.elevation = -13.0;  // degrees
  camera_.distance = 2.3;     // m
  scene_.flags[mjRND_HAZE] = 1;
  scene_.flags[mjRND_SHADOW] = 1;
}

SceneView::~SceneView() {
  mjr_freeContext(&context_);
  mjv_freeScene(&scene_);
}

void SceneView::draw(const mjrRect& viewport, const Eigen::Vector3d& target) {
  const Eigen::Vector3d look_at = target + look_at_offset;
  std::copy_n(look_at.data(), 3, camera_.lookat);
  mjv_updateScene(robot_.mj.get(), data_.get(), &visibility_, nullptr, &camera_, mjCAT_ALL,
                  &scene_);
  place_sun(target);
  switch_haze_on();
  mjr_render(viewport, &scene_, &context_);
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
