#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// The estimator that every table shows beside the others.
inline constexpr std::string_view always_contact_name = "always_contact";

/// The estimator that does not listen: P(contact) = 1. Its success rate is the share of contact in
/// the test runs, which every other success rate has to be read against.
EstimatorEntry always_contact_entry();

/// The ground truth as an estimator: it repeats a run's labels step by step, so that whatever
/// scores, tables or draws an estimator can be held to perfect scores. `Signals` carry no truth: it
/// is made for one run, with that run's labels. Those of steps that it does not hear of pass, by
/// the time. After the last one it believes the flat prior.
class Oracle : public ContactEstimator {
 public:
  explicit Oracle(std::array<scoring::ContactSequence, models::wheel_count> contact,
                  double sample_rate = 1000.0)
      : contact_(std::move(contact)), sample_rate_(sample_rate) {}

  /// Back to the first label.
  void reset() noexcept override;
  const Belief& update(const Signals& signals) noexcept override;

 private:
  std::array<scoring::ContactSequence, models::wheel_count> contact_;
  double sample_rate_;
  std::size_t step_ = 0;  ///< whose label is next
  double time_ = 0.0;     ///< of the step before
  Belief belief_;
};

EstimatorEntry oracle_entry();

/// The baseline that anyone would try first.
EstimatorEntry free_fall_entry();

/// What runs on Upkie.
EstimatorEntry upkie_observer_entry();

}  // namespace touchdown::experiments
