#include "scenarios/external_forces.hpp"

namespace touchdown {

std::span<const ExternalWrench> ExternalForces::on(const Simulator& simulator) {
  wrenches_.clear();
  if (scenario_.tether) {
    wrenches_.push_back({tether_force(*scenario_.tether, simulator.ground_truth()),
                         scenario_.tether->point_in_base});
  }
  for (const Guide& guide : scenario_.guides) {
    wrenches_.push_back({guide_force(guide, simulator.ground_truth()), guide.point_in_base});
  }
  const Observation& now = simulator.observation();
  for (const TimedForce& force : scenario_.forces) {
    if (force.acts_at(now.time)) {
      wrenches_.push_back({force_in_world(force, now.yaw), force.point_in_base});
    }
  }
  return wrenches_;
}

}  // namespace touchdown
