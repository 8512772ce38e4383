#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "viewer/live/run.hpp"

namespace touchdown::viewer {

/// What a picture of a live run shows: a copy, so that the simulation never waits for a picture.
struct LiveState {
  models::Observation observation;
  models::GroundTruth truth;
  std::uint64_t steps = 0;
  double period = 1e-3;  ///< of a control step (s)
  std::optional<recordings::Outcome> outcome;
  std::array<bool, models::wheel_count> contact = {};         ///< true contact
  std::array<bool, models::wheel_count> policy_contact = {};  ///< that the policy received
  struct Estimate {
    std::array<double, models::wheel_count> p_contact;
    std::array<bool, models::wheel_count> contact;
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
