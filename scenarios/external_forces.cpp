#include "scenarios/external_forces.hpp"

namespace touchdown::scenarios {

std::span<const simulators::ExternalWrench> ExternalForces::on(
    const simulators::Simulator& simulator) {
  wrenches_.clear();
  if (scenario_.tether) {
    wrenches_.push_back({policies::tether_force(*scenario_.tether, simulator.ground_truth()),
                         scenario_.tether->point_in_base});
  }
  for (const policies::Guide& guide : scenario_.guides) {
    wrenches_.push_back(
        {policies::guide_force(guide, simulator.ground_truth()), guide.point_in_base});
  }
  const models::Observation& now = simulator.observation();
  for (const policies::TimedForce& force : scenario_.forces) {
    if (force.acts_at(now.time)) {
      wrenches_.push_back({policies::force_in_world(force, now.yaw), force.point_in_base});
    }
  }
  return wrenches_;
}

}  // namespace touchdown::scenarios
