#include "apps/viewer/live_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "logs/signals_from.hpp"
#include "scenarios/engine.hpp"
#include "scoring/labels.hpp"

namespace touchdown::viewer {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

constexpr auto pause_between_batches = std::chrono::milliseconds(2);
constexpr double longest_debt = 0.05;  // s: beyond it, simulated time falls behind the clock
constexpr double rate_interval = 1.0;  // s
/// Steps for which the run is locked. Pictures and commands wait no longer.
constexpr int most_steps_at_once = 8;

using WheelContacts = std::array<bool, models::wheel_count>;

constexpr double largest_velocity = 1.5;  // m/s
constexpr double largest_yaw_rate = 2.0;  // rad/s
constexpr double largest_crouch = 1.2;    // rad
constexpr double longest_delay = 0.2;     // s: of the policy's contact
constexpr double longest_run = 1e5;       // s
constexpr std::uint64_t pull_steps = 10;  // control steps with the same force of a drag
constexpr double gravity = 9.81;          // m/s²
// A drag is a spring and a damper per kilogram of the robot: 1 m lifts a robot at 10 times its
// weight, but the force is limited.
constexpr double drag_stiffness = 100.0;  // 1/s²
constexpr double drag_damping = 12.0;     // 1/s
constexpr double largest_drag = 3.0;      // weights of the robot
// A hop: bend the legs, then extend them quickly, as in scenarios/hop.yaml.
constexpr double hop_crouch = 0.9, hop_extension = 0.3;            // rad
constexpr double hop_crouch_rate = 1.5, hop_extension_rate = 8.0;  // rad/s
constexpr double hop_delay = 0.8;                                  // s
constexpr double crouch_rate = 0.6;                                // rad/s

/// The scenario without an end, for a user to stop.
LiveScene endless(LiveScene scene) {
  if (scene.run >= 0) {
    scene.scenario = scenarios::perturbed(scene.scenario, scene.seed, scene.run);
  }
  scene.scenario.end.x = std::numeric_limits<double>::infinity();
  scene.scenario.end.duration = longest_run;
  return scene;
}

noise::NoiseKey noise_key(const LiveScene& scene) {
  return {scene.seed, static_cast<std::uint64_t>(std::max(scene.run, std::int64_t{0}))};
}

}  // namespace

RealTimeLoop::RealTimeLoop(std::unique_ptr<LiveRun> run)
    : run_(std::move(run)), thread_([this] { loop(); }) {}

RealTimeLoop::~RealTimeLoop() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void RealTimeLoop::use(const std::function<void(LiveRun&)>& action) {
  const std::lock_guard lock(mutex_);
  action(*run_);
}

std::unique_ptr<LiveRun> RealTimeLoop::replace(std::unique_ptr<LiveRun> run) {
  const std::lock_guard lock(mutex_);
  std::swap(run_, run);
  restarted_ = true;
  changed_.notify_all();
  return run;
}

void RealTimeLoop::set_speed(double speed) {
  const std::lock_guard lock(mutex_);
  speed_ = speed;
  restarted_ = true;
}

void RealTimeLoop::set_paused(bool paused) {
  const std::lock_guard lock(mutex_);
  paused_ = paused;
  single_steps_ = 0;
  restarted_ = true;
  changed_.notify_all();
}

void RealTimeLoop::step(int count) {
  const std::lock_guard lock(mutex_);
  single_steps_ += count;
  changed_.notify_all();
}

/// Waits while there is nothing to simulate. False: the loop has to end.
bool RealTimeLoop::wait_for_work(std::unique_lock<std::mutex>& lock) {
  const auto is_idle = [this] {
    return !stopped_ && (run_->outcome() || (paused_ && single_steps_ == 0));
  };
  if (is_idle()) {
    rate_ = 0.0;
    restarted_ = true;
    changed_.wait(lock, [&] { return !is_idle(); });
  }
  return !stopped_;
}

void RealTimeLoop::loop() {
  Clock::time_point last = Clock::now();
  Clock::time_point rate_since = last;
  double debt = 0.0;       // simulated time that the clock is ahead (s)
  double simulated = 0.0;  // since `rate_since` (s)
  std::unique_lock lock(mutex_);
  try {
    while (wait_for_work(lock)) {
      const double period = run_->simulator().control_period();
      if (paused_) {
        for (; single_steps_ > 0; --single_steps_) run_->step();
        continue;
      }
      const Clock::time_point now = Clock::now();
      if (std::exchange(restarted_, false)) {
        last = rate_since = now;
        debt = simulated = 0.0;
      }
      debt = std::min(debt + speed_ * seconds_between(last, now), std::max(longest_debt, period));
      last = now;
      for (int k = 0; k < most_steps_at_once && debt >= period && !run_->outcome(); ++k) {
        run_->step();
        debt -= period;
        simulated += period;
      }
      if (const double elapsed = seconds_between(rate_since, now); elapsed > rate_interval) {
        rate_ = simulated / elapsed;
        rate_since = now;
        simulated = 0.0;
      }
      lock.unlock();
      if (debt < period) std::this_thread::sleep_for(pause_between_batches);
      lock.lock();
    }
  } catch (...) {
    error_ = std::current_exception();
  }
}

LiveState RealTimeLoop::state() {
  const std::lock_guard lock(mutex_);
  if (error_) std::rethrow_exception(error_);
  const simulators::Simulator& simulator = run_->simulator();
  LiveState state{.observation = simulator.observation(),
                  .truth = simulator.ground_truth(),
                  .steps = run_->steps(),
                  .period = simulator.control_period(),
                  .outcome = run_->outcome(),
                  .contact = run_->true_contact(),
                  .policy_contact = run_->policy_contact(),
                  .estimates = {},
                  .drag_force = run_->drag_force(),
                  .velocity = run_->velocity(),
                  .yaw_rate = run_->yaw_rate(),
                  .hip = run_->hip(),
                  .samples = run_->take_samples(),
                  .rate = rate_};
  for (const LiveEstimator& estimator : run_->estimators()) {
    const auto& wheel = estimator.belief.wheel;
    state.estimates.push_back({{wheel[0].contact, wheel[1].contact},
                               {wheel[0].load, wheel[1].load},
                               estimator.accuracy()});
  }
  return state;
}

LiveRun::LiveRun(LiveScene scene, const std::vector<experiments::LogEstimator>& estimators,
                 const LiveSettings& settings, bool records)
    : scene_(endless(std::move(scene))),
      settings_(settings),
      records_(records),
      simulator_(scenarios::make_simulator(scene_.scenario, scene_.engine)),
      sensors_(settings.sensors, noise_key(scene_), simulator_->control_period()) {
  const double rate = 1.0 / simulator_->control_period();
  for (const experiments::LogEstimator& estimator : estimators) {
    estimators_.push_back({.title = estimator.entry.title, .estimator = estimator.make(rate)});
    estimators_.back().estimator->reset();
  }
  make_contact_sources();
  settings_.contact_source = std::min(settings_.contact_source, source_names_.size() - 1);
  contact_delay_ = scenarios::ContactDelay(steps_of(longest_delay));
  scenarios::Scenario undelayed = scene_.scenario;
  undelayed.policy.delay = 0.0;  // `contact_for_policy` delays
  rollout_ = std::make_unique<scenarios::Rollout>(
      undelayed, *simulator_,
      [this](const models::Observation& observation, const models::Action* previous) {
        return contact_for_policy(observation, previous);
      });
  recording_.info = scenarios::recording_info(scene_.scenario, *simulator_, scene_.seed,
                                              std::max(scene_.run, std::int64_t{0}));
}

std::size_t LiveRun::steps_of(double seconds) const {
  return static_cast<std::size_t>(std::llround(seconds / simulator_->control_period()));
}

void LiveRun::make_contact_sources() {
  scenarios::Scenario scenario = scene_.scenario;
  scenario.policy.delay = 0.0;
  source_names_.push_back(scenario.policy.contact);
  built_in_sources_.push_back(scenarios::policy_contact(scenario, *simulator_));
  if (scenario.policy.contact != "truth") {
    scenario.policy.contact = "truth";
    source_names_.push_back(scenario.policy.contact);
    built_in_sources_.push_back(scenarios::policy_contact(scenario, *simulator_));
  }
  for (const LiveEstimator& estimator : estimators_) source_names_.push_back(estimator.title);
}

WheelContacts LiveRun::contact_for_policy(const models::Observation& observation,
                                          const models::Action* previous) {
  reported_ = observation;
  sensors_.report(std::span(&reported_, 1));
  if (!std::isnan(reported_.time)) {
    reported_ = noise::with_noise(reported_, noise_key(scene_), step_, settings_.noise);
    std::optional<models::Action> action;
    if (previous != nullptr) {
      action = *previous;
      noise::report_targets(settings_.sensors, noise_key(scene_), std::span(&*action, 1));
    }
    const Signals signals = logs::signals_from(reported_, action ? &*action : nullptr);
    for (LiveEstimator& estimator : estimators_) {
      estimator.belief = estimator.estimator->update(signals);
    }
  }
  WheelContacts now = {true, true};
  for (std::size_t i = 0; i < built_in_sources_.size(); ++i) {  // all of them keep a state
    const WheelContacts contact = built_in_sources_[i](observation, previous);
    if (i == settings_.contact_source) now = contact;
  }
  if (settings_.contact_source >= built_in_sources_.size()) {
    const Belief& belief = estimators_[settings_.contact_source - built_in_sources_.size()].belief;
    now = {belief.wheel[0].contact, belief.wheel[1].contact};
  }
  const WheelContacts given = contact_delay_.add(now, steps_of(settings_.contact_delay));
  if (contact_script_.empty() ? given != WheelContacts{true, true} : given != policy_contact_) {
    contact_script_.push_back({observation.time, given[0], given[1]});
  }
  policy_contact_ = given;
  return given;
}

WheelContacts LiveRun::true_contact() const {
  const auto& force = simulator_->ground_truth().wheel_normal_force;
  const double threshold = scoring::force_threshold({}, recording_.info.robot_mass);
  return {force[0] > threshold, force[1] > threshold};
}

void LiveRun::step() {
  if (outcome()) return;
  pull();
  const models::Observation& observation = simulator_->observation();
  const models::Action& action = rollout_->act();
  if (records_) {
    recording_.observation.push_back(observation);
    recording_.action.push_back(action);
    recording_.truth.push_back(simulator_->ground_truth());
  }
  const WheelContacts contact = true_contact();
  if (step_ > 0) {  // no force has acted before the first step
    for (LiveEstimator& estimator : estimators_) {
      for (std::size_t wheel = 0; wheel < contact.size(); ++wheel) {
        ++estimator.steps;
        estimator.wrong += estimator.belief.wheel[wheel].contact != contact[wheel] ? 1 : 0;
      }
    }
  }
  if (step_ % sample_steps == 0) sample();
  ++step_;
  if (!outcome()) rollout_->advance();
}

void LiveRun::sample() {
  LiveSample sample{
      .contact = true_contact(),
      .p_contact = {},
      .wheel_torque =
          static_cast<float>(reported_.servo[models::index(models::Servo::left_wheel)].torque),
      .knee_torque =
          static_cast<float>(reported_.servo[models::index(models::Servo::left_knee)].torque),
      .acceleration = static_cast<float>(models::vertical_acceleration(reported_.imu))};
  if (step_ == 0) sample.contact = {true, true};
  for (const LiveEstimator& estimator : estimators_) {
    sample.p_contact.push_back({static_cast<float>(estimator.belief.wheel[0].p_contact),
                                static_cast<float>(estimator.belief.wheel[1].p_contact)});
  }
  samples_.push_back(std::move(sample));
}

std::vector<LiveSample> LiveRun::take_samples() { return std::exchange(samples_, {}); }

/// Adds the force of a drag as short constant forces, so that the scenario repeats it.
void LiveRun::pull() {
  if (step_ % pull_steps != 0) return;
  drag_force_.setZero();
  if (!drag_) return;
  const models::GroundTruth& truth = simulator_->ground_truth();
  const Eigen::Vector3d lever = truth.base_orientation * handle();
  const Eigen::Vector3d position = truth.base_position + lever;
  const Eigen::Vector3d velocity =
      truth.base_linear_velocity + truth.base_angular_velocity.cross(lever);
  const double mass = simulator_->model().mj->body_subtreemass[0];
  drag_force_ = mass * (drag_stiffness * (drag_->target - position) - drag_damping * velocity);
  const double most = largest_drag * gravity * mass;
  if (drag_force_.norm() > most) drag_force_ *= most / drag_force_.norm();
  rollout_->apply({.time = simulator_->observation().time,
                   .duration = static_cast<double>(pull_steps) * simulator_->control_period(),
                   .force = drag_force_,
                   .point_in_base = handle()});
}

void LiveRun::change(const LiveSettings& settings) {
  if (!(settings.sensors == settings_.sensors)) {
    sensors_ =
        noise::ReportingSensors(settings.sensors, noise_key(scene_), simulator_->control_period());
  }
  settings_ = settings;
  settings_.contact_source = std::min(settings_.contact_source, source_names_.size() - 1);
  settings_.contact_delay = std::clamp(settings_.contact_delay, 0.0, longest_delay);
}

void LiveRun::drive(double more_velocity, double more_yaw_rate) {
  rollout_->drive(std::clamp(velocity() + more_velocity, -largest_velocity, largest_velocity),
                  std::clamp(yaw_rate() + more_yaw_rate, -largest_yaw_rate, largest_yaw_rate));
}

void LiveRun::crouch(double more) {
  rollout_->crouch(std::clamp(hip() + more, 0.0, largest_crouch), crouch_rate);
}

void LiveRun::hop() {
  rollout_->crouch(hop_crouch, hop_crouch_rate);
  rollout_->crouch(hop_extension, hop_extension_rate, hop_delay);
}

logs::Recording LiveRun::recording() const {
  logs::Recording recording = recording_;
  scenarios::Scenario scenario = rollout_->scenario();
  scenario.policy.contact = "script";
  scenario.policy.contact_script = contact_script_;
  if (!recording.observation.empty()) {
    scenario.end.duration = recording.observation.back().time;
  }
  recording.info.scenario_yaml = scenarios::to_yaml(scenario);
  recording.info.outcome = outcome().value_or(logs::Outcome::finished);
  return recording;
}

}  // namespace touchdown::viewer
