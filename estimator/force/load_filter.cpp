#include "estimator/force/load_filter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "estimator/low_pass.hpp"

namespace touchdown {

namespace {

// As shares of the weight. Loads in contact are taken as uniform between the first two. Heavier
// ones than half of that are certain enough.
constexpr double lightest = 0.019;
constexpr double heaviest = 0.76;
constexpr double clearly = 0.38;
constexpr double largest_lead = 0.38;
constexpr double lead_deviation = 0.076;  // that halves the lead

constexpr double slope_time = 0.004;        // s: of the low-pass for a load's slope
constexpr double lateness = 0.0046;         // s: of loads, behind all low-passes
constexpr double evidence_time = 0.002;     // s: errors of the load are alike for that long
constexpr double most_evidence = 6.0;       // nats in each evidence time
constexpr double takeoff_rate = 5.0;        // 1/s
constexpr double landing_rate = 10.0;       // 1/s
constexpr double lowest_lead_rate = 500.0;  // Hz

/// Of a standard normal distribution.
double probability_below(double x) noexcept { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

}  // namespace

LoadFilter::LoadFilter(const LoadFilterConfig& config)
    : config_(config),
      guard_(config.guard, config.sample_rate),
      loads_(config.geometry, config.sample_rate, config.guard),
      lead_(config.sample_rate < lowest_lead_rate ? 0.0 : config.lead),
      slope_gain_(exact_low_pass_gain(slope_time, config.sample_rate)),
      evidence_share_(std::min(1.0, 1.0 / (evidence_time * config.sample_rate))),
      p_takeoff_(std::min(0.5, takeoff_rate / config.sample_rate)),
      p_landing_(std::min(0.5, landing_rate / config.sample_rate)) {
  check_members(config);
  reset();
}

void LoadFilter::reset() noexcept {
  guard_.reset();
  loads_.reset();
  wheel_ = {};
  belief_ = Belief{};
}

const Belief& LoadFilter::estimate(const Signals& signals) noexcept {
  const SignalGuard::Verdict verdict = guard_.check(signals.time, signals.vertical_acceleration);
  if (verdict.restart) {
    loads_.restart();
    wheel_ = {};
  }
  belief_.status = verdict.status;
  const DynamicLoads::Loads loads = loads_.update(signals, verdict.acceleration_good);
  const DynamicLoads::Loads known = loads_.known(loads);
  for (std::size_t side = 0; side < 2; ++side) {
    WheelBelief& belief = belief_.wheel[side];
    belief.load = known[side];
    const bool is_measured = std::isfinite(loads[side].force);
    if (!is_measured || verdict.restart) {
      belief.p_contact = guard_.relaxed(belief.p_contact, verdict.elapsed);
    }
    if (!is_measured) {
      wheel_[side] = {};
      if (belief_.status == SignalStatus::good) belief_.status = SignalStatus::invalid;
      continue;
    }
    const double evidence = evidence_of(wheel_[side], loads[side].force / loads_.weight(),
                                        loads[side].deviation / loads_.weight());
    belief.p_contact = updated(belief.p_contact, evidence);
    // A load that changes was another one when it was measured.
    const double change = loads[side].force - wheel_[side].smoothed * loads_.weight();
    const double noise = loads[side].deviation;
    const double beyond_noise = std::sqrt(std::max(0.0, change * change - noise * noise));
    belief.load.deviation = std::hypot(belief.load.deviation, lateness / slope_time * beyond_noise);
    belief.contact =
        belief.p_contact >= (belief.contact ? config_.leave_below : config_.return_above);
  }
  if (belief_.status == SignalStatus::good && !loads_.has_targets()) {
    belief_.status = SignalStatus::degraded;
  }
  multiply_wheels(belief_);
  return belief_;
}

double LoadFilter::evidence_of(Wheel& wheel, double load, double deviation) const noexcept {
  if (!wheel.is_started) wheel = {load, true};
  wheel.smoothed += slope_gain_ * (load - wheel.smoothed);
  const double fall = std::max(0.0, (wheel.smoothed - load) / slope_time);
  const double uncertainty = deviation / lead_deviation;
  const double lead = lead_ / (1.0 + uncertainty * uncertainty);
  // The lead announces a load of zero, never a negative one.
  const double ahead = std::max(load - std::min(lead * fall, largest_lead), std::min(load, 0.0));
  const double above = std::min(ahead, clearly);
  const double in_contact = (probability_below((above - lightest) / deviation) -
                             probability_below((above - heaviest) / deviation)) /
                            (heaviest - lightest);
  // Against a normal density around zero, which a negative load does not contradict.
  const double scale = deviation * std::sqrt(2.0 * std::numbers::pi);
  const double deviations = std::max(ahead, 0.0) / deviation;
  const double ratio = std::log(in_contact * scale) + 0.5 * deviations * deviations;
  return std::clamp(ratio, -most_evidence, most_evidence) * evidence_share_;
}

double LoadFilter::updated(double p_contact, double evidence) const noexcept {
  const double stays = (1.0 - p_takeoff_) * p_contact + p_landing_ * (1.0 - p_contact);
  const double odds = stays / (1.0 - stays) * std::exp(evidence);
  return odds / (1.0 + odds);
}

}  // namespace touchdown
