// Fits every kind of estimator of the library to a synthetic run, runs it on another one, and
// prints its beliefs: "name step P(left) P(right) P(any) P(both) left right status". The output on
// another processor must be the same up to rounding.

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

#include "estimator/estimator.hpp"
#include "tests/estimator/named_config.hpp"
#include "tests/estimator/neural/sample.hpp"
#include "tests/estimator/random.hpp"

namespace touchdown {
namespace {

constexpr double rate = 1000.0;  // Hz

/// Rounds like a sensor, so that the bits do not depend on how this processor's library rounds a
/// sine.
void round_to_grid(double& value) { value = std::nearbyint(value * 0x1p20) * 0x1p-20; }

/// A run with its true contact.
struct LabelledSignals {
  std::vector<Signals> signals;
  std::array<std::vector<bool>, 2> contact;
};

/// `drops` drops of one second each, then half a second of hanging: a robot rolls, unloads its
/// wheels, falls and lands with a shock. The left wheel leaves the ground first.
LabelledSignals whole_run(int drops, std::uint32_t seed) {
  test::Normal normal(seed);
  LabelledSignals run;
  for (int k = 0; k < 1000 * drops + 500; ++k) {
    const bool hangs = k >= 1000 * drops;
    const int phase = k % 1000;
    const bool falls = !hangs && phase >= 700 && phase < 900;
    const double load = hangs || falls ? 0.0 : phase >= 600 && phase < 700 ? 0.4 : 1.0;
    const double shock = phase >= 900 ? std::exp(-(phase - 900) / 20.0) : 0.0;
    Signals s;
    s.time = (k + 1) / rate;
    s.vertical_acceleration = (hangs   ? 0.0
                               : falls ? -9.81
                                       : (load - 1.0) * 9.81 + 80.0 * shock) +
                              0.35 * normal();
    s.linear_acceleration = {0.3 * normal(), 0.3 * normal(), s.vertical_acceleration};
    s.angular_velocity = {0.1 * normal(), 0.1 * normal(), 0.1 * normal()};
    s.ground_velocity_command = 0.5;
    for (std::size_t side = 0; side < 2; ++side) {
      const double sign = side == 0 ? 1.0 : -1.0;
      const bool air = hangs || (falls && (side == 0 || phase >= 706));
      const double spin = air ? 0.2 * static_cast<double>(k % 100) : 0.0;
      LegSignals& leg = s.leg[side];
      leg.hip = {sign * 0.455, 0.05 * normal(), sign * 0.8 + 0.05 * normal()};
      leg.knee = {-sign * 0.791, 0.05 * normal(),
                  sign * (1.3 * load + 6.0 * shock + 0.02 * std::sin(0.05 * k)) + 0.07 * normal()};
      leg.wheel = {sign * 0.01 * static_cast<double>(k), sign * (10.0 + spin) + 0.2 * normal(),
                   sign * (0.3 * load - 0.8 * shock) + 0.07 * normal()};
      for (JointSignals* const joint : {&leg.hip, &leg.knee, &leg.wheel}) {
        round_to_grid(joint->position);
        round_to_grid(joint->velocity);
        round_to_grid(joint->torque);
      }
      run.contact[side].push_back(!air);
    }
    round_to_grid(s.vertical_acceleration);
    for (double& value : s.linear_acceleration) round_to_grid(value);
    for (double& value : s.angular_velocity) round_to_grid(value);
    run.signals.push_back(s);
  }
  return run;
}

/// The run for the estimators, with the faults of a robot's: lost reports, a gap, a frozen sensor.
std::vector<Signals> faulty_run() {
  std::vector<Signals> signals = whole_run(3, 11).signals;
  for (std::size_t k = 1200; k < 1230; ++k) {
    signals[k].leg[0].knee.torque = std::numeric_limits<double>::quiet_NaN();
  }
  for (std::size_t k = 1400; k < 1420; ++k) {
    signals[k].vertical_acceleration = std::numeric_limits<double>::infinity();
  }
  for (std::size_t k = 2200; k < signals.size(); ++k) signals[k].time += 0.125;
  for (std::size_t k = 2950; k < signals.size(); ++k) {
    signals[k].vertical_acceleration = signals[2950].vertical_acceleration;
  }
  return signals;
}

MeasurementModel fitted(const LabelledSignals& run, MeasurementConfig config) {
  config.fit.knee_count = config.fit.wheel_count = 50;  // qemu computes slowly
  std::vector<TorqueSample> samples[2];
  for (const Side side : {Side::left, Side::right}) {
    const auto leg = static_cast<std::size_t>(side);
    TorqueChannel channel(config.torque, side, rate);
    for (std::size_t k = 0; k < run.signals.size(); ++k) {
      samples[run.contact[leg][k] ? 1 : 0].push_back(channel.update(run.signals[k].leg[leg]));
    }
  }
  return fit_measurement_model(samples[1], samples[0], config.fit);
}

void print_beliefs(const char* name, ContactEstimator&& estimator,
                   const std::vector<Signals>& signals) {
  for (std::size_t k = 0; k < signals.size(); ++k) {
    const Belief& b = estimator.update(signals[k]);
    std::printf("%s %zu %.17g %.17g %.17g %.17g %d %d %d\n", name, k, b.wheel[0].p_contact,
                b.wheel[1].p_contact, b.p_any_wheel, b.p_both_wheels, b.wheel[0].contact,
                b.wheel[1].contact, static_cast<int>(b.status));
  }
}

void print_all_beliefs() {
  const LabelledSignals run = whole_run(2, 7);
  const std::vector<Signals> signals = faulty_run();
  for (const char* const name : {"paper", "reference", "robust"}) {
    const BayesFilterConfig config = test::named(name);
    print_beliefs(name, BayesFilter(fitted(run, config.measurement), config), signals);
  }
  const BayesFilterConfig robust = BayesFilterConfig::robust();
  print_beliefs("measurement_only", MeasurementOnly(fitted(run, robust.measurement), robust),
                signals);
  print_beliefs("neural", NeuralEstimator(test::shared(test::random_network())), signals);
  print_beliefs("free_fall", FreeFall(), signals);
  print_beliefs("load_filter", LoadFilter(), signals);
  print_beliefs("upkie_observer", UpkieObserver(), signals);
}

}  // namespace
}  // namespace touchdown

int main() { touchdown::print_all_beliefs(); }
