#include "experiments/estimators/oracle.hpp"

#include <algorithm>

namespace touchdown::experiments {

void Oracle::reset() noexcept {
  step_ = 0;
  belief_ = {};
}

const Belief& Oracle::update(const Signals& /*signals*/) noexcept {
  belief_ = {};
  if (step_ >= std::min(contact_[0].size(), contact_[1].size())) return belief_;
  for (std::size_t side = 0; side < 2; ++side) {
    const bool touches = contact_[side][step_] != 0;
    belief_.wheel[side] = {.p_contact = touches ? 1.0 : 0.0, .contact = touches};
  }
  const auto [fewer, more] = std::minmax(belief_.wheel[0].p_contact, belief_.wheel[1].p_contact);
  belief_.p_both_wheels = fewer;
  belief_.p_any_wheel = more;
  ++step_;
  return belief_;
}

EstimatorEntry oracle_entry() {
  return {.name = "oracle",
          .title = "Oracle",
          .summary = "repeats the ground truth: what a perfect estimator would score",
          .sensors = {},
          .needs_truth = true,
          .make = [](const EstimatorEntry& /*entry*/,
                     const EstimatorSetup& setup) -> std::unique_ptr<ContactEstimator> {
            return std::make_unique<Oracle>(
                setup.truth == nullptr ? std::array<scoring::ContactSequence, models::wheel_count>{}
                                       : *setup.truth);
          }};
}

}  // namespace touchdown::experiments
