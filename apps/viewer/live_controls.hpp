#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/viewer/live_run.hpp"
#include "experiments/logs/estimator.hpp"

namespace touchdown::viewer {

struct LiveRequest {
  LiveScene scene;
  std::vector<experiments::LogEstimator> estimators;
  std::vector<std::pair<std::string, noise::SensorProfile>> sensors;  ///< to choose from
  std::filesystem::path record = {};  ///< recording to write at the end; empty: none
  int width = 1280, height = 720;     ///< of the window
  bool measures = false;              ///< the parts of each picture, which takes a little longer
};

/// Numbers that keys and sliders change.
enum class LiveNumber : int { torque_noise, acceleration_noise, contact_delay };
inline constexpr std::size_t live_numbers = 3;

/// A number's values: from zero to `most`, and the change by a key.
struct LiveRange {
  double step, most;
};
LiveRange range_of(LiveNumber number);

/// A live run in real time, and all that a user changes of it. A recorded run is saved when another
/// one starts.
class LiveControls {
 public:
  /// `started` is called when a run has started, while the run before still exists.
  LiveControls(LiveRequest request, std::function<void()> started);

  const LiveScene& scene() const { return request_.scene; }
  const LiveSettings& settings() const { return settings_; }
  const std::vector<std::string>& estimators() const { return estimators_; }
  const std::vector<std::string>& contact_sources() const { return sources_; }
  const std::vector<std::string>& sensor_profiles() const { return sensor_names_; }
  std::size_t sensors() const { return sensors_; }  ///< index of the profile
  double speed() const { return speed_; }           ///< simulated seconds per second
  bool is_paused() const { return is_paused_; }
  const simulators::Simulator& simulator() const { return *simulator_; }

  LiveState state() { return loop_.state(); }
  double value(LiveNumber number) const;
  void set(LiveNumber number, double value);

  /// Commands the run, between two steps.
  void use(const std::function<void(LiveRun&)>& action) { loop_.use(action); }

  void pause(bool paused);
  /// Pauses and simulates this many control steps.
  void step(int count);
  void scale_speed(double factor);

  void restart();
  void start_next_draw();
  void change_engine();
  void choose_contact_source(std::size_t index);
  void choose_sensors(std::size_t index);

  /// Saves the present run, if runs are recorded.
  void save();
  /// One line per saved recording.
  const std::vector<std::string>& saved() const { return saved_; }

 private:
  std::unique_ptr<LiveRun> make_run();
  void take_over();
  void change(const std::function<void(LiveSettings&)>& action);

  LiveRequest request_;
  std::function<void()> started_;
  LiveSettings settings_;
  RealTimeLoop loop_;
  const simulators::Simulator* simulator_ = nullptr;
  std::vector<std::string> estimators_;  ///< titles
  std::vector<std::string> sources_;     ///< of contact for the policy
  std::vector<std::string> sensor_names_;
  std::size_t sensors_ = 0;
  double speed_ = 1.0;
  bool is_paused_ = false;
  std::vector<std::string> saved_;
};

}  // namespace touchdown::viewer
