#include "experiments/signals/motion.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::experiments {

namespace {

Eigen::Vector3d in_its_plane(const Eigen::Vector3d& link) { return {link.x(), 0.0, link.z()}; }

}  // namespace

odometry::WheeledBiped wheeled_biped(const models::RobotModel& robot) {
  const models::MjDataPtr data = models::at_zero(robot);
  const Eigen::Vector3d imu = robot.imu_position;
  odometry::WheeledBiped biped;
  biped.imu_in_base = models::imu_convention().toRotationMatrix();
  biped.wheel_radius = robot.wheel_radius;
  for (std::size_t side = 0; side < models::wheel_count; ++side) {
    odometry::WheeledLeg& leg = biped.leg[side];
    std::array<Eigen::Vector3d, 3> anchor;
    for (std::size_t i = 0; i < anchor.size(); ++i) {
      const std::size_t servo = anchor.size() * side + i;
      if (!robot.has(servo)) {
        // A leg without a hip has one that never turns, and an upper link without length.
        anchor[i] = models::vector_at(data->xanchor, robot.joint[servo + 1]);
        leg.turn[i] = servo < anchor.size() ? -1.0 : 1.0;
        continue;
      }
      const int joint = robot.joint[servo];
      anchor[i] = models::vector_at(data->xanchor, joint);
      const double along = models::vector_at(data->xaxis, joint).y();
      leg.turn[i] = along > 0.0 ? 1.0 : -1.0;
      constexpr double parallel = 1e-3;
      if (std::abs(along) >= 1.0 - parallel) continue;
      throw InputError(fmt::format("{}: odometry: expected a joint '{}' about the base's y axis",
                                   robot.name, models::servo_names[servo]));
    }
    const Eigen::Vector3d tyre = models::vector_at(data->geom_xpos, robot.tyre_geom[side]);
    leg.hip = anchor[0] - imu;
    leg.hip.y() = (tyre - imu).y();
    leg.upper = in_its_plane(anchor[1] - anchor[0]);
    leg.lower = in_its_plane(tyre - anchor[1]);
  }
  return biped;
}

RunMotion motion_of(const recordings::Recording& recording, const models::RobotModel& robot) {
  const Eigen::Vector3d imu = robot.imu_position;
  RunMotion motion{wheeled_biped(robot), {}, {}};
  motion.specific_force.reserve(recording.steps());
  motion.truth.reserve(recording.steps());
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    motion.specific_force.push_back(recording.observation[k].imu.raw_linear_acceleration);
    const models::GroundTruth& truth = recording.truth[k];
    motion.truth.push_back({recording.period() * static_cast<double>(k),
                            truth.base_position + truth.base_orientation * imu,
                            truth.base_orientation, truth.imu_linear_velocity});
  }
  return motion;
}

}  // namespace touchdown::experiments
