#include "models/tyre.hpp"

#include "core/fields.hpp"

namespace touchdown::models {

std::vector<double> Tyre::strips() const {
  if (width == 0.0) return {0.0};
  // Three strips have 8/9 of the tilting stiffness of a whole cylinder.
  return {0.0, width / 3.0, -width / 3.0};
}

void describe(Fields& fields, Tyre& tyre) {
  fields.choose("law", {"engine", "spring_damper"}, tyre.law)
      .doc("The engine's own contact model, or one spring and damper in both engines.");
  if (!fields.reading() && tyre.law == Tyre::Law::engine) return;
  fields("stiffness", tyre.stiffness, 100.0, 1e7)
      .doc("N/m", "Stiffness of a whole wheel; only with `spring_damper`.");
  fields("damping", tyre.damping, 1.0, 1e4)
      .doc("N·s/m", "Damping of a whole wheel; only with `spring_damper`.");
  fields("width", tyre.width, 0.0, 1.0)
      .doc("m", "Width along the axle, 0 for a sphere; only with `spring_damper`.");
  for (const char* key : {"stiffness", "damping", "width"}) {
    fields.check(tyre.law == Tyre::Law::spring_damper || !fields.present(key, false), key,
                 "expected 'law: spring_damper' beside it");
  }
}

}  // namespace touchdown::models
