#pragma once

#include <array>
#include <cstddef>

#include "estimator/contact_estimator.hpp"
#include "experiments/labels.hpp"

namespace touchdown {

/// The ground truth as an estimator: it repeats a run's labels step by step, so that whatever
/// scores, tables or draws an estimator can be held to perfect scores. `Signals` carry no truth:
/// `begin` (experiments/heard_run.hpp) tells it to this class by type, and other estimators have
/// nothing to be told by. Before it is told, and after the last label, it believes the flat prior.
class Oracle : public ContactEstimator {
 public:
  /// The labels that the next updates answer with, one per update.
  void tell(const std::array<ContactSequence, 2>& contact);

  /// Forgets the labels too.
  void reset() noexcept override;
  const Belief& update(const Signals& signals) noexcept override;

 private:
  std::array<ContactSequence, 2> contact_;
  std::size_t step_ = 0;
  Belief belief_;
};

}  // namespace touchdown
