#pragma once

#include "estimator/contact_estimator.hpp"

namespace touchdown {

/// The estimator that does not listen: P(contact) = 1. Its success rate is the share of contact in
/// the test runs, which every other success rate has to be read against.
class AlwaysContact : public ContactEstimator {
 public:
  void reset() noexcept override {}
  const Belief& update(const Signals& /*signals*/) noexcept override { return belief_; }

 private:
  const Belief belief_ = {.wheel = {{{1.0, true}, {1.0, true}}},
                          .p_any_wheel = 1.0,
                          .p_both_wheels = 1.0,
                          .status = SignalStatus::good};
};

}  // namespace touchdown
