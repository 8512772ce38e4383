#include "tests/logs/log/sample_recording.hpp"

#include <cmath>
#include <limits>

namespace touchdown::logs::test {

namespace {

/// Numbers with full mantissas, each once.
class Numbers {
 public:
  double next() {
    ++count_;
    return std::sin(static_cast<double>(count_)) * std::exp2(count_ % 40 - 20);
  }
  Eigen::Vector3d vector() {
    const double x = next();
    const double y = next();
    return {x, y, next()};
  }
  Eigen::Quaterniond rotation() {
    const double w = next();
    const Eigen::Vector3d v = vector();
    return Eigen::Quaterniond(w, v.x(), v.y(), v.z()).normalized();
  }

 private:
  int count_ = 0;
};

}  // namespace

Recording sample_recording(std::size_t steps, bool with_truth) {
  Numbers numbers;
  Recording recording;
  recording.info = {"stairs", "mujoco",          0xfedcba9876543210U, -7,
                    1000,     Outcome::finished, "name: stairs # ü\n"};
  for (std::size_t step = 0; step < steps; ++step) {
    models::Observation observation;
    observation.time = 1e-3 * static_cast<double>(step);
    for (models::ServoReading& servo : observation.servo) {
      servo = {numbers.next(), numbers.next(), numbers.next()};
    }
    observation.imu = {numbers.rotation(), numbers.vector(), numbers.vector(), numbers.vector()};
    observation.pitch = numbers.next();
    observation.pitch_rate = numbers.next();
    observation.yaw = numbers.next();
    observation.yaw_rate = numbers.next();
    recording.observation.push_back(observation);
    models::Action action;
    for (models::ServoCommand& servo : action.servo) {
      servo = {numbers.next(), numbers.next(), numbers.next(),
               numbers.next(), numbers.next(), numbers.next()};
    }
    recording.action.push_back(action);
    if (!with_truth) continue;
    recording.truth.push_back({numbers.vector(),
                               numbers.rotation(),
                               numbers.vector(),
                               numbers.vector(),
                               numbers.vector(),
                               {numbers.next(), numbers.next()},
                               step % 3 == 1});
  }
  if (steps > 1) {
    using Limits = std::numeric_limits<double>;
    recording.action[1].servo[2].position = Limits::quiet_NaN();
    recording.action[1].servo[2].maximum_torque = Limits::infinity();
    recording.observation[1].servo[0].torque = -0.0;
    recording.observation[1].servo[0].velocity = Limits::denorm_min();
    recording.observation[1].servo[1].position = 3.0;
  }
  return recording;
}

}  // namespace touchdown::logs::test
