#pragma once

#include "estimator/contact_estimator.hpp"
#include "estimator/force/dynamic_loads.hpp"
#include "estimator/members.hpp"
#include "estimator/signal_guard.hpp"

namespace touchdown {

struct LoadFilterConfig {
  double sample_rate = 1000.0;  ///< at which `update` is called (Hz)
  LegGeometry geometry = {};
  /// How far ahead a falling load is followed (s). Rates below 500 Hz have no lead, because a slope
  /// between two of their samples comes too late.
  double lead = 0.005;
  // Chosen by F1 on drawn scenes of seed 301: all families in both engines, with and without noise.
  double leave_below = 0.02;   ///< out of contact once P(contact) falls below this …
  double return_above = 0.85;  ///< … until it exceeds this
  SignalGuardConfig guard = {};
};

void members(auto& visit, MembersOf<LoadFilterConfig> auto& config) {
  members(visit, config.geometry);
  visit("lead", config.lead, Range::not_negative);
  visit("leave_below", config.leave_below, Range::inner_share);
  visit("return_above", config.return_above,
        Range{config.leave_below, Range::inner_share.high, "from leave_below to less than 1"});
  members(visit, config.guard);
}

/// A filter with two states for each wheel, contact and air, that observes the load on it
/// (`DynamicLoads`) with its deviation (docs/explanation/contact.md). In the air the load is zero
/// up to its error; in contact, all loads between a fiftieth and three quarters of the weight are
/// alike. Beliefs have the load with the deviation of its lag, too. It needs the robot's geometry
/// and nothing else: all constants are of physics, or chosen once for all robots.
///
/// `update` never throws, allocates or locks, and never returns NaN. While a load is not known, the
/// wheel's belief relaxes to the prior, and the status gives the reason.
class LoadFilter : public ContactEstimator {
 public:
  /// Errors: as `check_members`; `InputError` for a rate that is not positive.
  explicit LoadFilter(const LoadFilterConfig& config = {});

  void reset() noexcept override;

 private:
  struct Wheel {
    double smoothed = 0.0;  ///< low-passed load, as a share of the weight
    bool is_started = false;
  };

  const Belief& estimate(const Signals& signals) noexcept override;
  /// ln P(load | contact)/P(load | air), with both as shares of the weight.
  double evidence_of(Wheel& wheel, double load, double deviation) const noexcept;
  double updated(double p_contact, double evidence) const noexcept;

  LoadFilterConfig config_;
  SignalGuard guard_;
  DynamicLoads loads_;
  double lead_;
  double slope_gain_;
  double evidence_share_;  ///< of a step's evidence that is new
  double p_takeoff_;       ///< in one step
  double p_landing_;
  std::array<Wheel, 2> wheel_;
  Belief belief_;
};

}  // namespace touchdown
