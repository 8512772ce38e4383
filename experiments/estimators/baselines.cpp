#include "experiments/estimators/baselines.hpp"

#include <algorithm>
#include <cmath>

#include "estimator/free_fall.hpp"
#include "estimator/upkie_observer.hpp"
#include "experiments/estimators/entries.hpp"

namespace touchdown::experiments {

namespace {

class AlwaysContact : public ContactEstimator {
 public:
  void reset() noexcept override {}

 private:
  const Belief& estimate(const Signals& /*signals*/) noexcept override { return belief_; }

  const Belief belief_ = {.wheel = {{{1.0, true}, {1.0, true}}},
                          .p_any_wheel = 1.0,
                          .p_both_wheels = 1.0,
                          .status = SignalStatus::good};
};

using EstimatorPointer = std::unique_ptr<ContactEstimator>;

EstimatorPointer make_always_contact(const EstimatorEntry& /*entry*/,
                                     const EstimatorSetup& /*setup*/) {
  return std::make_unique<AlwaysContact>();
}

EstimatorPointer make_oracle(const EstimatorEntry& /*entry*/, const EstimatorSetup& setup) {
  return std::make_unique<Oracle>(setup.truth == nullptr
                                      ? std::array<scoring::ContactSequence, models::wheel_count>{}
                                      : *setup.truth,
                                  setup.sample_rate);
}

EstimatorPointer make_free_fall(const EstimatorEntry& entry, const EstimatorSetup& setup) {
  return std::make_unique<FreeFall>(FreeFallConfig{.sample_rate = setup.sample_rate,
                                                   .low_pass = entry.chosen("low_pass"),
                                                   .half_way = entry.chosen("half_way")});
}

EstimatorPointer make_upkie_observer(const EstimatorEntry& entry, const EstimatorSetup& setup) {
  WheelContactConfig wheel;
  wheel.liftoff_inertia = entry.chosen("liftoff_inertia");
  wheel.touchdown_inertia = wheel.liftoff_inertia * entry.chosen("touchdown_ratio");
  wheel.cutoff = entry.chosen("cutoff");
  return std::make_unique<UpkieObserver>(
      UpkieObserverConfig{.wheel = wheel, .time_step = 1.0 / setup.sample_rate});
}

/// An estimator that ignores all signals. Its accuracy is the share of contact in the test runs,
/// the reference for every other accuracy.
EstimatorEntry always_contact_entry() {
  return {.name = std::string(always_contact_name),
          .title = "Always contact",
          .summary = "Reports contact at every step, so its success rate is the share of contact",
          .reason = "reference: the score without any signal",
          .sensors = {},
          .making = {.by_step = make_always_contact}};
}

EstimatorEntry oracle_entry() {
  return {.name = "oracle",
          .title = "Oracle",
          .summary = "Repeats the ground truth, which gives the scores of a perfect estimator",
          .reason = "reference: the best score",
          .sensors = {},
          .knows = {.truth = true},
          .making = {.by_step = make_oracle}};
}

EstimatorEntry free_fall_entry() {
  return {.name = "free_fall",
          .title = "Free fall",
          .summary = "Detects flight by a threshold on the vertical acceleration",
          .reason = "cost: an accelerometer and one comparison",
          .sensors = {.acceleration = true},
          .hyperparameters = {between("half_way", FreeFallConfig{}.half_way, -9.0, -1.0),
                              around("low_pass", FreeFallConfig{}.low_pass, 5.0)},
          .making = {.by_step = make_free_fall}};
}

EstimatorEntry upkie_observer_entry() {
  // It uses hip and knee torques only for the floor contact of the whole robot, not per wheel.
  return {.name = "upkie_observer",
          .title = "Upkie's observer",
          .summary = "Thresholds the apparent inertia of each wheel, as Upkie's software does",
          .reason = "history: what Upkie runs today",
          .sensors = {.wheel_torque = true, .joint_velocity = true},
          .hyperparameters = {around("liftoff_inertia", WheelContactConfig{}.liftoff_inertia, 3.0),
                              around("touchdown_ratio", 4.0, 3.5),
                              around("cutoff", WheelContactConfig{}.cutoff, 10.0)},
          .making = {.by_step = make_upkie_observer}};
}

}  // namespace

void Oracle::reset() noexcept {
  step_ = 0;
  belief_ = {};
}

const Belief& Oracle::estimate(const Signals& signals) noexcept {
  belief_ = {};
  const double steps = std::round((signals.time - time_) * sample_rate_);
  if (step_ > 0 && steps > 1.0 && steps < 1e9) step_ += static_cast<std::size_t>(steps) - 1;
  time_ = signals.time;
  if (step_ >= std::min(contact_[0].size(), contact_[1].size())) return belief_;
  for (std::size_t side = 0; side < 2; ++side) {
    const bool in_contact = contact_[side][step_] != 0;
    belief_.wheel[side] = {.p_contact = in_contact ? 1.0 : 0.0, .contact = in_contact};
  }
  const auto [fewer, more] = std::minmax(belief_.wheel[0].p_contact, belief_.wheel[1].p_contact);
  belief_.p_both_wheels = fewer;
  belief_.p_any_wheel = more;
  ++step_;
  return belief_;
}

std::vector<EstimatorEntry> observer_entries() {
  return {upkie_observer_entry(), free_fall_entry()};
}

std::vector<EstimatorEntry> reference_entries() { return {oracle_entry(), always_contact_entry()}; }

}  // namespace touchdown::experiments
