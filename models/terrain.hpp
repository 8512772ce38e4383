#pragma once

#include <variant>
#include <vector>

#include "core/yaml.hpp"

namespace touchdown {

/// Level ground (m).
struct Flat {
  double length = 1.0;
};

/// A flight of stairs going down: `count` times a drop of `rise`, each followed by a tread of
/// length `run` (m). The tread that one starts from is the piece before; the last drop's tread
/// belongs to the flight.
struct StairFlight {
  int count = 7;
  double run = 1.0;
  double rise = 0.25;
  double nosing_radius = 0.025;  ///< of the rounded edge (m)
};

/// A slope of `incline` (degrees, positive), up by `rise` if that is positive, down if negative
/// (m).
struct Ramp {
  double incline = 8.0;
  double rise = 0.15;
};

/// A block on the ground: a vertical front of `height`, a top of `length`, and a rounded edge from
/// which one drops back to the level before it (m).
struct Platform {
  double length = 1.0;
  double height = 0.25;
  double nosing_radius = 0.025;
};

/// One edge: the ground goes on lower by `drop` (m).
struct Step {
  double drop = 0.12;
  double nosing_radius = 0.025;
};

using TerrainPiece = std::variant<Flat, StairFlight, Ramp, Platform, Step>;

/// What the robot rolls over, as data: pieces laid end to end along +x from `start_x`. Their end is
/// level with the floor, an infinite plane at z = 0 that lies everywhere else; the height at which
/// they begin follows. No pieces: the floor alone.
struct Terrain {
  std::vector<TerrainPiece> pieces;
  double start_x = -2.0;  ///< where the first piece begins (m)
  double width = 3.0;     ///< extent in y, centred on y = 0 (m)
  int repeat = 1;         ///< the list of pieces is laid down this many times
  double friction = 1.0;  ///< sliding friction of every robot–terrain contact
};

/// Reads
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
/// strictly; every key has the default of its struct. Errors: `InputError`.
Terrain terrain_from_yaml(YamlMap&& map);

/// The same terrain, every value spelled out: `terrain_from_yaml` reads it back.
YAML::Node to_yaml(const Terrain& terrain);

/// Height of the ground's surface at x, with its rounded edges (m). At a drop itself: the lower
/// side. Errors: `InputError` if the pieces do not fit together (see `Profile`).
double height_at(const Terrain& terrain, double x);

/// The x of every edge that one drops from, in order (m). Errors: as `height_at`.
std::vector<double> edges(const Terrain& terrain);

}  // namespace touchdown
