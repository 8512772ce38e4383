#pragma once

#include <array>
#include <cstdint>
#include <deque>

#include <Eigen/Core>

#include "logs/plausibility/findings.hpp"
#include "models/robot.hpp"

namespace touchdown::logs {

/// By how much the IMU comes after the joints, or before them. Rolling wheels, hips and knees give
/// the acceleration that the IMU measures, at the same time and whatever the sizes of the robot: at
/// another delay the IMU explains less of the wheels' acceleration.
class Lateness {
 public:
  /// `period`: between two records (s).
  explicit Lateness(double period);

  void add(const models::Observation& record);
  void report(Findings& findings) const;

 private:
  static constexpr int most = 25;  ///< steps of about 10 ms
  static constexpr std::size_t delays = 2 * most + 1;
  static constexpr std::size_t span = 8;  ///< steps, of an acceleration
  /// Accelerations: of wheels, hips and knees, left and right together (rad/s²); of the IMU
  /// forwards and upwards (m/s²) and in pitch (rad/s²).
  using Step = Eigen::Matrix<double, 6, 1>;

  void add_step();
  /// How well the IMU, so many steps later, explains the wheels' acceleration.
  struct Fit {
    double explained = 0.0;        ///< share of what hips and knees do not
    double turns_per_metre = 0.0;  ///< of the wheels, by the forward acceleration (rad/m)
  };
  Fit fit(int delay) const;

  std::int64_t length_;  ///< records of a step
  double step_;          ///< s
  std::int64_t count_ = 0;
  double time_ = 0.0;
  Step sum_ = Step::Zero();  ///< of the step: speeds, and the IMU's accelerations
  std::deque<Step> means_;   ///< of the last steps
  std::deque<Step> steps_;   ///< the last `delays` accelerations
  int total_ = 0;
  std::array<Eigen::Matrix<double, 6, 6>, delays> products_;
};

}  // namespace touchdown::logs
