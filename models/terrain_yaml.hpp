#pragma once

#include "models/terrain.hpp"

namespace touchdown {
class Fields;
}

namespace touchdown::models {

/// The keys of a terrain, for example:
///
///     start_x: -2
///     width: 3
///     friction: 1
///     repeat: 1
///     pieces:
///       - flat: {length: 3}
///       - stairs: {count: 7, run: 1, rise: 0.25, nosing_radius: 0.025}
///       - ramp: {incline: 8, rise: 0.15}
///       - platform: {length: 1, height: 0.25, nosing_radius: 0.025}
///       - step: {drop: 0.12, nosing_radius: 0.025}
///
/// The defaults are those of the structs.
void describe(Fields& fields, Terrain& terrain);

}  // namespace touchdown::models
