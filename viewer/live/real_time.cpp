#include "viewer/live/real_time.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

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
    state.estimates.push_back({{wheel[0].p_contact, wheel[1].p_contact},
                               {wheel[0].contact, wheel[1].contact},
                               estimator.accuracy()});
  }
  return state;
}

}  // namespace touchdown::viewer
