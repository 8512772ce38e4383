#include "policies/force_script.hpp"

#include <Eigen/Geometry>

#include "policies/vector_yaml.hpp"

namespace touchdown::policies {

Eigen::Vector3d force_in_world(const TimedForce& force, double yaw) {
  if (!force.along_heading) return force.force;
  return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * force.force;
}

void describe(Fields& fields, TimedForce& force) {
  fields("time", force.time, 0.0, 1e6);
  fields("duration", force.duration, 0.0, 1e6);
  describe_vector(fields, "force", force.force);
  describe_vector(fields, "point_in_base", force.point_in_base);
  fields("along_heading", force.along_heading);
}

}  // namespace touchdown::policies
