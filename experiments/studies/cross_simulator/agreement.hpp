#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/studies/cross_simulator/histogram.hpp"
#include "experiments/rollouts/rollouts.hpp"
#include "scoring/bootstrap.hpp"

namespace touchdown::experiments {

/// A mean whose parts add.
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

/// What is compared between engines before any estimator listens; docs/cross_simulator.md says how
/// each is measured.
enum class Quantity : int {
  flight_duration,    ///< ms
  peak_acceleration,  ///< of a landing (m/s²)
  edge_contact_steps,       ///< per drop
  bounces,            ///< per drop
  contact_ratio,
  descent,  ///< time to the bottom (s)
};
inline constexpr std::size_t quantity_count = 6;

/// Torque distributions: joint by joint, in contact and in flight.
enum class TorqueSet : int { knee_contact, knee_flight, wheel_contact, wheel_flight };
inline constexpr std::size_t torque_set_count = 4;

/// Everything of one run that is compared; runs add.
struct RunFacts {
  std::array<Mean, quantity_count> quantity;
  std::array<Histogram, torque_set_count> torque;

  RunFacts& operator+=(const RunFacts& other);
};

RunFacts facts_of(const Rollout& run, const Experiment& experiment);

/// One quantity in both engines and the second's minus the first's on the same runs.
struct QuantityAgreement {
  std::string name;
  std::string unit;
  Interval first, second, difference;
};

/// How far apart the engines' torque distributions are.
struct TorqueAgreement {
  std::string name;
  Interval distance;  ///< Wasserstein (N·m)
  Interval overlap;
  /// The distance of one engine's even runs from its odd ones, the greater of the two engines: what
  /// equal distributions would show (N·m).
  double within_engine = 0.0;
};

struct Agreement {
  std::size_t runs = 0;  ///< that both engines got through
  std::vector<QuantityAgreement> quantities;
  std::vector<TorqueAgreement> torques;
};

/// Entry i of both belongs to the same draw of the perturbations.
Agreement agreement(const std::vector<RunFacts>& first, const std::vector<RunFacts>& second,
                    const scoring::BootstrapConfig& config);

}  // namespace touchdown::experiments
