#pragma once

#include <vector>

namespace touchdown {
class Fields;
}

namespace touchdown::models {

/// Contact model of both tyres. By default each engine uses its own model with the parameters of
/// the scenario's `simulation.contact`. A rubber tyre is the same spring and damper in both
/// engines. It pushes and never pulls:
///
///     F = max(0, stiffness·δ + damping·δ̇)      δ: compression of the tyre (m)
///
/// A tyre with a width consists of strips side by side, each with its share of the spring and the
/// damper. An edge below a part of the tyre meets only a part of the stiffness.
struct Tyre {
  enum class Law { engine, spring_damper };

  Law law = Law::engine;
  double stiffness = 2e4;  ///< of a whole wheel (N/m)
  double damping = 80.0;   ///< of a whole wheel (N·s/m)
  double width = 0.0;      ///< along the axle (m); 0 for a sphere, with contact at its middle only

  /// Positions of the strips along the axle, relative to the tyre's middle (m): the centres of
  /// equal parts, the middle one included.
  std::vector<double> strips() const;
};

/// The keys are the names of the members.
void describe(Fields& fields, Tyre& tyre);

}  // namespace touchdown::models
