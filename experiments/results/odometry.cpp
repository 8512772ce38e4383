#include "experiments/results/odometry.hpp"

#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "estimator/odometry/filter.hpp"
#include "experiments/estimators/baselines.hpp"
#include "experiments/results/captions.hpp"

namespace touchdown::experiments {

namespace {

odometry::LegJoints joints_of(const LegSignals& leg) {
  return {{leg.hip.position, leg.knee.position, leg.wheel.position},
          {leg.hip.velocity, leg.knee.velocity, leg.wheel.velocity}};
}

ContactTrack delayed_labels(const RunSignals& run, std::size_t steps) {
  ContactTrack track;
  for (std::size_t wheel = 0; wheel < track.size(); ++wheel) {
    track[wheel].assign(run.steps(), 1.0);
    for (std::size_t k = steps; k < run.steps(); ++k) {
      track[wheel][k] = run.contact[wheel][k - steps] != 0 ? 1.0 : 0.0;
    }
  }
  return track;
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

std::vector<std::string> oracle_names(const std::vector<double>& delays) {
  std::vector<std::string> names = {"truth"};
  for (const double delay : delays) names.push_back(fmt::format("truth_delayed_{}ms", 1e3 * delay));
  return names;
}

std::vector<ContactTrack> oracle_tracks(const std::vector<double>& delays, const RunSignals& run) {
  const double period = run.period();
  std::vector<ContactTrack> tracks = {delayed_labels(run, 0)};
  for (const double delay : delays) {
    tracks.push_back(delayed_labels(run, static_cast<std::size_t>(std::llround(delay / period))));
  }
  return tracks;
}

std::string contact_name(std::string_view estimator) {
  return estimator == always_contact_name ? "always" : std::string(estimator);
}

std::string contact_title(const std::string& contact) {
  if (contact == "truth") return "Truth (oracle)";
  double milliseconds = 0.0;
  if (std::sscanf(contact.c_str(), "truth_delayed_%lfms", &milliseconds) == 1) {
    return fmt::format("Truth, delayed {} ms (oracle)", milliseconds);
  }
  return estimator_title(contact == "always" ? std::string(always_contact_name) : contact);
}

}  // namespace touchdown::experiments
