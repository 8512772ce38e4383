#pragma once

#include <vector>

namespace touchdown {
class Fields;
}

namespace touchdown::models {

/// How the tyres of both wheels meet the ground. By default each engine does as it likes, with the
/// numbers of the scenario's `simulation.contact`. A tyre of rubber is the same spring and damper
/// in both engines, which pushes and never pulls:
///
///     F = max(0, stiffness·δ + damping·δ̇)      δ, how far the tyre is pressed in (m)
///
/// One that has a width is made of strips side by side, each with its share of the spring and the
/// damper: an edge that carries a part of the wheel carries it with a part of the stiffness.
struct Tyre {
  enum class Law { engine, spring_damper };

  Law law = Law::engine;
  double stiffness = 2e4;  ///< of a whole wheel (N/m)
  double damping = 80.0;   ///< of a whole wheel (N·s/m)
  double width = 0.0;      ///< across; 0 for a sphere, which carries at its middle alone (m)

  /// Where its strips are along the axle, from its middle (m): the middles of equal parts, the
  /// tyre's own middle among them.
  std::vector<double> strips() const;
};

/// Keys are the members' names.
void describe(Fields& fields, Tyre& tyre);

}  // namespace touchdown::models
