#include "experiments/odometry/dead_reckoning.hpp"

#include "estimator/odometry/filter.hpp"

namespace touchdown::experiments {

namespace {

odometry::LegJoints joints_of(const LegSignals& leg) {
  return {{leg.hip.position, leg.knee.position, leg.wheel.position},
          {leg.hip.velocity, leg.knee.velocity, leg.wheel.velocity}};
}

}  // namespace

scoring::Trajectory dead_reckoned(const RunSignals& run, const NoiseRun& noise,
                                  const noise::SensorNoise& levels, const TrackView& p_contact) {
  odometry::ContactOdometry filter({.robot = run.motion->robot});
  scoring::Trajectory trajectory;
  trajectory.reserve(run.steps());
  for (std::size_t k = 0; k < run.steps(); ++k) {
    if (has_record(run.signals[k])) {
      const Signals signals = noisy(run, noise, levels, k);
      filter.update({.time = signals.time,
                     .angular_velocity = signals.angular_velocity,
                     .specific_force = run.motion->specific_force[k] + signals.linear_acceleration -
                                       run.signals[k].linear_acceleration,
                     .leg = {joints_of(signals.leg[0]), joints_of(signals.leg[1])},
                     .p_contact = {p_contact[0][k], p_contact[1][k]}});
    }
    const odometry::ExtendedPose& pose = filter.state().pose;
    trajectory.push_back({run.motion->truth[k].time, pose.position,
                          Eigen::Quaterniond(pose.rotation), pose.velocity});
  }
  return trajectory;
}

scoring::TrajectoryScore score_odometry(const RunSignals& run, const NoiseRun& noise,
                                        const noise::SensorNoise& levels,
                                        const TrackView& p_contact,
                                        const scoring::ScoringConfig& scoring) {
  return scoring::score_trajectory(dead_reckoned(run, noise, levels, p_contact), run.motion->truth,
                                   scoring::first_scored_step(run.info.control_period_us, scoring));
}

}  // namespace touchdown::experiments
