#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/plan/rollouts.hpp"
#include "scoring/bootstrap.hpp"
#include "scoring/histogram.hpp"

namespace touchdown::experiments {

/// A mean as a sum and a count, so that parts can be added.
struct Mean {
  double sum = 0.0;
  double count = 0.0;

  void add(double value) {
    sum += value;
    count += 1.0;
  }
  Mean& operator+=(const Mean& other) {
    sum += other.sum;
    count += other.count;
    return *this;
  }
  double value() const { return sum / count; }
};

/// Quantities of the runs that are compared between engines, independent of estimators.
/// docs/reference/metrics.md defines each.
enum class Quantity : int {
  flight_duration,    ///< ms
  peak_acceleration,  ///< of a landing (m/s²)
  edge_contacts,      ///< per drop
  bounces,            ///< per drop
  contact_ratio,
  descent,  ///< time to the bottom (s)
};
inline constexpr std::size_t quantity_count = 6;

/// Torque distributions: joint by joint, in contact and in flight.
enum class TorqueSet : int { knee_contact, knee_flight, wheel_contact, wheel_flight };
inline constexpr std::size_t torque_set_count = 4;

/// The compared quantities of one run; those of several runs can be added.
struct RunFacts {
  std::array<Mean, quantity_count> quantity;
  std::array<scoring::Histogram, torque_set_count> torque;

  RunFacts& operator+=(const RunFacts& other);
};

RunFacts facts_of(const Rollout& run, const Experiment& experiment);

/// One quantity in both engines, and the second's minus the first's on the same runs.
struct QuantityAgreement {
  std::string name;
  std::string unit;
  Interval first, second, difference;
};

/// The distance between the engines' torque distributions.
struct TorqueAgreement {
  std::string name;
  Interval distance;  ///< Wasserstein (N·m)
  Interval overlap;
  /// Distance between the even and the odd runs of one engine, the greater of both engines (N·m):
  /// the value to expect for equal distributions.
  double within_engine = 0.0;
};

struct Agreement {
  std::size_t runs = 0;  ///< completed in both engines
  std::vector<QuantityAgreement> quantities;
  std::vector<TorqueAgreement> torques;
};

/// Entry i of both has the same draw of the perturbations.
Agreement agreement(const std::vector<RunFacts>& first, const std::vector<RunFacts>& second,
                    const scoring::BootstrapConfig& config);

}  // namespace touchdown::experiments
