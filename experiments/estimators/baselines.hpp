#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "experiments/estimators/entry.hpp"

namespace touchdown::experiments {

/// The estimator that every table shows as a baseline.
inline constexpr std::string_view always_contact_name = "always_contact";

/// The ground truth as an estimator: it repeats a run's labels step by step. Scores, tables and
/// plots can thereby be checked against perfect scores. `Signals` hold no ground truth, so an
/// oracle is made for one run, with that run's labels. It skips the labels of missing steps by
/// their time. After the last label it reports the uniform prior.
class Oracle : public ContactEstimator {
 public:
  explicit Oracle(std::array<scoring::ContactSequence, models::wheel_count> contact,
                  double sample_rate = 1000.0)
      : contact_(std::move(contact)), sample_rate_(sample_rate) {}

  /// Returns to the first label.
  void reset() noexcept override;

 private:
  const Belief& estimate(const Signals& signals) noexcept override;

  std::array<scoring::ContactSequence, models::wheel_count> contact_;
  double sample_rate_;
  std::size_t step_ = 0;  ///< index of the next label
  double time_ = 0.0;     ///< of the previous step (s)
  Belief belief_;
};

}  // namespace touchdown::experiments
