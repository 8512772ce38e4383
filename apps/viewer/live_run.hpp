#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "experiments/logs/estimator.hpp"
#include "logs/recording.hpp"
#include "noise/reported_signals.hpp"
#include "noise/sensor_noise.hpp"
#include "scenarios/rollout.hpp"
#include "scenarios/scenario.hpp"
#include "simulators/simulator.hpp"

namespace touchdown::viewer {

/// What runs: a scenario, with random draws if `run` is not negative, in an engine.
struct LiveScene {
  scenarios::Scenario scenario;
  std::string engine = "mujoco";
  std::uint64_t seed = 1;
  std::int64_t run = -1;
};

/// What a user may change during a run.
struct LiveSettings {
  noise::SensorNoise noise;        ///< added to the estimators' signals
  noise::SensorProfile sensors;    ///< between the robot and its estimators
  std::size_t contact_source = 0;  ///< of the policy: an index of `LiveRun::contact_sources()`
  double contact_delay = 0.0;      ///< of the contact that the policy receives (s)
};

/// An estimator of a live run and its scores so far.
struct LiveEstimator {
  std::string title;
  std::unique_ptr<ContactEstimator> estimator;
  Belief belief = {};
  std::uint64_t steps = 0;  ///< both wheels added
  std::uint64_t wrong = 0;  ///< decisions that differ from the true contact

  double accuracy() const {
    return steps == 0 ? 1.0 : 1.0 - static_cast<double>(wrong) / static_cast<double>(steps);
  }
};

/// Values of one time for curves.
struct LiveSample {
  std::array<bool, models::wheel_count> contact;                  ///< true contact
  std::vector<std::array<float, models::wheel_count>> p_contact;  ///< by estimator
  float wheel_torque, knee_torque;                                ///< left, reported (N·m)
  float acceleration;                                             ///< vertical (m/s²)
};

/// A spring from the robot's handle to a point in the world, held by a user.
struct Drag {
  Eigen::Vector3d target;  ///< m, world
};

/// A run that a user watches and drives. It has no clock: the same calls between the same steps
/// give the same run, and `recording()` repeats through the engine (`scenarios::play`).
class LiveRun {
 public:
  /// Steps between two samples.
  static constexpr std::uint64_t sample_steps = 4;
  /// The point of the base that a drag pulls (m, base frame).
  static Eigen::Vector3d handle() { return {0.0, 0.0, 0.06}; }

  /// `estimators` must outlive this. `records`: keeps all steps for `recording()`. Errors: those of
  /// `scenarios::make_simulator` and of `LogEstimator::make`.
  LiveRun(LiveScene scene, const std::vector<experiments::LogEstimator>& estimators,
          const LiveSettings& settings, bool records);
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  /// Advances by one control step, unless the run is over.
  void step();

  /// The names of contact sources for the policy: the scenario's own, the truth, every estimator.
  const std::vector<std::string>& contact_sources() const { return source_names_; }

  const LiveSettings& settings() const { return settings_; }
  void change(const LiveSettings& settings);
  /// Adds to the commanded speed (m/s) and yaw rate (rad/s), and to the bend of the legs (rad), up
  /// to limits.
  void drive(double more_velocity, double more_yaw_rate);
  void crouch(double more);
  void stop_driving() { rollout_->drive(0.0, 0.0); }
  void hop();
  void drag(const std::optional<Drag>& drag) { drag_ = drag; }

  const LiveScene& scene() const { return scene_; }
  const simulators::Simulator& simulator() const { return *simulator_; }
  const std::vector<LiveEstimator>& estimators() const { return estimators_; }
  const std::optional<logs::Outcome>& outcome() const { return rollout_->outcome(); }
  std::uint64_t steps() const { return step_; }
  double velocity() const { return rollout_->driving().velocity; }  ///< commanded (m/s)
  double yaw_rate() const { return rollout_->driving().yaw_rate; }  ///< commanded (rad/s)
  double hip() const { return rollout_->commanded_hip(); }          ///< commanded (rad)
  std::array<bool, models::wheel_count> true_contact() const;
  std::array<bool, models::wheel_count> policy_contact() const { return policy_contact_; }
  /// The force of the drag on the robot (N, world).
  const Eigen::Vector3d& drag_force() const { return drag_force_; }

  /// The samples since the last call.
  std::vector<LiveSample> take_samples();

  /// The run so far, with the scenario that repeats it. Needs `records`.
  logs::Recording recording() const;

 private:
  std::array<bool, models::wheel_count> contact_for_policy(const models::Observation& observation,
                                                           const models::Action* previous);
  void make_contact_sources();
  std::size_t steps_of(double seconds) const;
  void pull();
  void sample();

  LiveScene scene_;
  LiveSettings settings_;
  bool records_;
  std::unique_ptr<simulators::Simulator> simulator_;
  std::vector<LiveEstimator> estimators_;
  noise::ReportingSensors sensors_;
  std::vector<std::string> source_names_;
  std::vector<policies::WheelContact> built_in_sources_;
  scenarios::ContactDelay contact_delay_{0};
  std::array<bool, models::wheel_count> policy_contact_ = {true, true};
  policies::ContactScript contact_script_;
  models::Observation reported_;
  std::unique_ptr<scenarios::Rollout> rollout_;
  std::uint64_t step_ = 0;
  std::optional<Drag> drag_;
  Eigen::Vector3d drag_force_ = Eigen::Vector3d::Zero();
  std::vector<LiveSample> samples_;
  logs::Recording recording_;
};

/// What a picture of a live run shows: a copy, so that the simulation never waits for a picture.
struct LiveState {
  models::Observation observation;
  models::GroundTruth truth;
  std::uint64_t steps = 0;
  double period = 1e-3;  ///< of a control step (s)
  std::optional<logs::Outcome> outcome;
  std::array<bool, models::wheel_count> contact = {};         ///< true contact
  std::array<bool, models::wheel_count> policy_contact = {};  ///< that the policy received
  struct Estimate {
    std::array<bool, models::wheel_count> contact;
    std::array<WheelLoad, models::wheel_count> load;
    double accuracy;
  };
  std::vector<Estimate> estimates;  ///< by estimator
  Eigen::Vector3d drag_force = Eigen::Vector3d::Zero();
  double velocity = 0.0, yaw_rate = 0.0, hip = 0.0;  ///< commanded
  std::vector<LiveSample> samples;                   ///< since the last state
  double rate = 0.0;  ///< simulated seconds per second, over the last second
};

/// Runs a live run in a thread of its own, in real time or at another speed. If the machine is too
/// slow, the run is slower than real time and `LiveState::rate` shows it.
class RealTimeLoop {
 public:
  explicit RealTimeLoop(std::unique_ptr<LiveRun> run);
  ~RealTimeLoop();
  RealTimeLoop(const RealTimeLoop&) = delete;
  RealTimeLoop& operator=(const RealTimeLoop&) = delete;

  /// Uses the run between two steps. Waits for the step in progress only.
  void use(const std::function<void(LiveRun&)>& action);
  /// Replaces the run by another one and returns the old one.
  std::unique_ptr<LiveRun> replace(std::unique_ptr<LiveRun> run);

  /// Simulated seconds per second.
  void set_speed(double speed);
  void set_paused(bool paused);
  /// While paused: simulates this many control steps.
  void step(int count);

  /// Errors: rethrows an error of the run.
  LiveState state();

 private:
  void loop();
  bool wait_for_work(std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::unique_ptr<LiveRun> run_;
  double speed_ = 1.0;
  bool paused_ = false;
  bool restarted_ = true;  ///< the clock starts anew
  bool stopped_ = false;
  int single_steps_ = 0;
  double rate_ = 0.0;
  std::exception_ptr error_;
  std::thread thread_;
};

}  // namespace touchdown::viewer
