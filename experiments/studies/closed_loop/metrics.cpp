#include "experiments/studies/closed_loop/metrics.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/plan/rollouts.hpp"
#include "scoring/score.hpp"

namespace touchdown::experiments {

namespace {

double ratio(double sum, std::int64_t count) {
  return count > 0 ? sum / static_cast<double>(count) : std::nan("");
}

odometry::LegJoints joints_of(const models::Observation& observation, std::size_t leg) {
  odometry::LegJoints joints;
  for (std::size_t i = 0; i < joints.position.size(); ++i) {
    const models::ServoReading& servo = observation.servo[joints.position.size() * leg + i];
    joints.position[i] = servo.position;
    joints.velocity[i] = servo.velocity;
  }
  return joints;
}

/// Steps at which a wheel lands after a flight of at least `shortest` steps.
std::vector<std::size_t> landings(const scoring::ContactSequence& contact, std::size_t shortest) {
  std::vector<std::size_t> steps;
  for (const scoring::Flight& flight : scoring::flights(contact)) {
    const bool lands = flight.takeoff > 0 && flight.landing < contact.size();
    if (lands && flight.landing - flight.takeoff >= shortest) steps.push_back(flight.landing);
  }
  return steps;
}

}  // namespace

double ClosedLoopMetrics::landing_speed_rms() const {
  return std::sqrt(ratio(squared_landing_speed, landings));
}
double ClosedLoopMetrics::mean_largest_pitch() const { return ratio(largest_pitch, runs); }
double ClosedLoopMetrics::mean_largest_force() const { return ratio(largest_force, runs); }
double ClosedLoopMetrics::false_takeoffs_per_minute() const {
  return 60e6 * ratio(static_cast<double>(false_takeoffs), contact_us);
}

ClosedLoopMetrics& ClosedLoopMetrics::operator+=(const ClosedLoopMetrics& other) {
  runs += other.runs;
  finished += other.finished;
  fell += other.fell;
  landings += other.landings;
  squared_landing_speed += other.squared_landing_speed;
  largest_pitch += other.largest_pitch;
  largest_force += other.largest_force;
  false_takeoffs += other.false_takeoffs;
  contact_us += other.contact_us;
  return *this;
}

std::array<double, models::wheel_count> tyre_speeds(const models::Observation& observation,
                                                    const models::GroundTruth& truth,
                                                    const odometry::WheeledBiped& robot) {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d base = truth.base_orientation.toRotationMatrix();
  const Eigen::Vector3d rate = base.transpose() * truth.base_angular_velocity;
  Eigen::Vector3d heading = base.col(0);
  heading.z() = 0.0;
  heading.normalize();
  std::array<double, models::wheel_count> speeds = {};
  for (std::size_t leg = 0; leg < speeds.size(); ++leg) {
    const odometry::WheelMotion wheel = motion_of(robot.leg[leg], joints_of(observation, leg));
    const Eigen::Vector3d axle =
        truth.imu_linear_velocity + base * (rate.cross(wheel.centre) + wheel.velocity);
    const Eigen::Vector3d spin = base * (rate + wheel.spin * Eigen::Vector3d::UnitY());
    speeds[leg] = heading.dot(robot.wheel_radius * spin.cross(up) - axle);
  }
  return speeds;
}

ClosedLoopMetrics closed_loop_metrics_of(
    const recordings::Recording& recording,
    const std::array<scoring::ContactSequence, models::wheel_count>& trace,
    const odometry::WheeledBiped& robot, const scoring::LabelConfig& labels,
    const scoring::ScoringConfig& scoring) {
  ClosedLoopMetrics metrics;
  metrics.runs = 1;
  const auto how = recording.info.outcome.value_or(recordings::Outcome::finished);
  metrics.finished = how == recordings::Outcome::finished ? 1 : 0;
  metrics.fell = is_failure(how) ? 1 : 0;
  const double period = recording.period();
  const auto shortest = static_cast<std::size_t>(std::llround(scoring.minimum_flight / period));
  const auto contact = scoring::contact_labels(recording, labels);
  for (std::size_t wheel = 0; wheel < models::wheel_count; ++wheel) {
    for (const std::size_t step : landings(contact[wheel], shortest)) {
      // The step before the landing: the ground has not changed the wheel's speed yet.
      const double speed =
          tyre_speeds(recording.observation[step - 1], recording.truth[step - 1], robot)[wheel];
      metrics.landings += 1;
      metrics.squared_landing_speed += speed * speed;
    }
  }
  for (std::size_t k = 0; k < recording.steps(); ++k) {
    const auto& force = recording.truth[k].wheel_normal_force;
    metrics.largest_force = std::max({metrics.largest_force, force[0], force[1]});
    metrics.largest_pitch =
        std::max(metrics.largest_pitch, std::abs(recording.observation[k].pitch));
  }
  const scoring::ContactSequence robot_contact = scoring::any_wheel(contact);
  for (const scoring::JudgedTransition& judged :
       judge_transitions(robot_contact, scoring::any_wheel(trace), period, scoring)) {
    const bool is_false_takeoff = judged.kind == scoring::EventKind::takeoff &&
                                  judged.verdict == scoring::Judgement::false_alarm;
    metrics.false_takeoffs += is_false_takeoff ? 1 : 0;
  }
  metrics.contact_us =
      recording.info.control_period_us * std::count(robot_contact.begin(), robot_contact.end(), 1);
  return metrics;
}

}  // namespace touchdown::experiments
