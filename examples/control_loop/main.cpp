// Contact estimation, and odometry with it, in a 1 kHz control loop. A made-up robot stands in for
// yours: it rolls, drops off a step every second, lands, and rolls on.
//
// Exit code 0 if the accuracy of contact is above 90 %, and the position error below 2 % of the
// distance.

#include <cmath>
#include <cstdio>
#include <random>
#include <touchdown/estimator.hpp>
#include <touchdown/odometry/filter.hpp>
#include <vector>

namespace {

constexpr double rate = 1000.0;  // Hz
constexpr double speed = 0.5;    // m/s, forward

bool in_the_air(double time) { return std::fmod(time, 1.0) > 0.8; }

/// Replaces your robot's servos and IMU.
class MadeUpRobot {
 public:
  touchdown::Signals read(double time) {
    const bool air = in_the_air(time);
    const double since_landing = time < 1.0 ? 1.0 : std::fmod(time, 1.0);
    touchdown::Signals signals;
    signals.time = time;
    signals.vertical_acceleration =
        (air ? -9.81 : 150.0 * std::exp(-since_landing / 0.01) * std::cos(600.0 * since_landing)) +
        0.2 * noise_(engine_);
    for (const touchdown::Side side : {touchdown::Side::left, touchdown::Side::right}) {
      // The right leg is the left one's mirror image, and so are the signs of its joints.
      const double sign = side == touchdown::Side::left ? 1.0 : -1.0;
      touchdown::LegSignals& leg = signals.leg[static_cast<std::size_t>(side)];
      leg.knee.torque = sign * (air ? 0.1 : 1.3) + 0.1 * noise_(engine_);
      leg.wheel.torque =
          sign * (air ? 0.0 : 0.2 + 0.1 * std::sin(7.0 * time)) + 0.05 * noise_(engine_);
    }
    return signals;
  }

 private:
  std::mt19937 engine_{1};
  std::normal_distribution<double> noise_;
};

/// Input of odometry: wheels that stand still in the air, and an IMU with x back and z down.
touchdown::odometry::OdometrySample odometry_sample(double time, const touchdown::Belief& belief) {
  touchdown::odometry::OdometrySample sample;
  sample.time = time;
  if (!in_the_air(time)) {
    sample.specific_force.z() = -9.81;
    sample.leg[0].velocity[2] = speed / 0.05;  // of a wheel of .05 m; the right one is mirrored
    sample.leg[1].velocity[2] = -speed / 0.05;
  }
  for (std::size_t wheel = 0; wheel < 2; ++wheel) {
    sample.p_contact[wheel] = belief.wheel[wheel].p_contact;
  }
  return sample;
}

/// Fits both densities to a labelled recording of one minute.
touchdown::MeasurementModel fit(const touchdown::BayesFilterConfig& config) {
  using touchdown::Side;
  MadeUpRobot robot;
  touchdown::TorqueChannel left(config.measurement.torque, Side::left, rate);
  touchdown::TorqueChannel right(config.measurement.torque, Side::right, rate);
  std::vector<touchdown::TorqueSample> contact;
  std::vector<touchdown::TorqueSample> no_contact;
  for (int step = 0; step < 60'000; ++step) {
    const double time = step / rate;
    const touchdown::Signals signals = robot.read(time);
    std::vector<touchdown::TorqueSample>& samples = in_the_air(time) ? no_contact : contact;
    samples.push_back(left.update(signals.leg[0]));
    samples.push_back(right.update(signals.leg[1]));
  }
  return touchdown::fit_measurement_model(contact, no_contact, config.measurement.fit);
}

}  // namespace

int main() {
  touchdown::BayesFilterConfig config = touchdown::BayesFilterConfig::robust();
  config.sample_rate = rate;
  touchdown::BayesFilter filter(fit(config), config);

  touchdown::odometry::ContactOdometry odometry;
  touchdown::odometry::OdometryState start;
  start.pose.velocity.x() = speed;
  odometry.reset(start);

  MadeUpRobot robot;
  int right = 0;
  bool contact = true;
  constexpr int steps = 10'000;
  for (int step = 0; step < steps; ++step) {
    const double time = step / rate;
    const touchdown::Belief& belief = filter.update(robot.read(time));

    if (!touchdown::is_used(belief.status)) {
      std::printf("%.3f s: signals not good, status %d\n", time, static_cast<int>(belief.status));
    }
    if (belief.wheel[0].contact != contact) {
      contact = belief.wheel[0].contact;
      std::printf("%.3f s: left wheel %s\n", time, contact ? "touches down" : "takes off");
    }
    odometry.update(odometry_sample(time, belief));
    right += belief.wheel[0].contact == !in_the_air(time) ? 1 : 0;
  }
  const double share = 100.0 * right / steps;
  std::printf("contact accuracy %.1f %%\n", share);
  const double x = odometry.state().planar().position.x();
  const double travelled = speed * (steps - 1) / rate;
  std::printf("travelled %.3f m, by odometry %.3f m\n", travelled, x);
  return share > 90.0 && std::abs(x - travelled) < 0.02 * travelled ? 0 : 1;
}
