#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// The ground truth as an estimator: it repeats a run's labels step by step, so that whatever
/// scores, tables or draws an estimator can be held to perfect scores. `Signals` carry no truth: it
/// is made for one run, with that run's labels. After the last one it believes the flat prior.
class Oracle : public ContactEstimator {
 public:
  explicit Oracle(std::array<scoring::ContactSequence, models::wheel_count> contact)
      : contact_(std::move(contact)) {}

  /// Back to the first label.
  void reset() noexcept override;
  const Belief& update(const Signals& signals) noexcept override;

 private:
  std::array<scoring::ContactSequence, models::wheel_count> contact_;
  std::size_t step_ = 0;
  Belief belief_;
};

EstimatorEntry oracle_entry();

}  // namespace touchdown::experiments
