#pragma once

#include <variant>
#include <vector>

namespace touchdown {
class Fields;
}

namespace touchdown::models {

/// Level ground (m).
struct Flat {
  double length = 1.0;
};

/// A flight of stairs going down: `count` times a drop of `rise`, each followed by a tread of
/// length `run` (m). The starting tread is the previous piece; the tread after the last drop
/// belongs to the flight.
struct StairFlight {
  int count = 7;
  double run = 1.0;
  double rise = 0.25;
  double nosing_radius = 0.025;  ///< of the rounded edge (m)
};

/// A slope of `incline` (degrees, positive) that goes up if `rise` is positive, down if negative
/// (m).
struct Ramp {
  double incline = 8.0;
  double rise = 0.15;
};

/// A block on the ground (m): a vertical front of `height`, a top of `length`, and a rounded edge
/// with a drop back to the previous level.
struct Platform {
  double length = 1.0;
  double height = 0.25;
  double nosing_radius = 0.025;
};

/// One edge: the ground after it is lower by `drop` (m).
struct Step {
  double drop = 0.12;
  double nosing_radius = 0.025;
};

struct Repetition;

using TerrainPiece = std::variant<Flat, StairFlight, Ramp, Platform, Step, Repetition>;

/// Pieces that are repeated `count` times.
struct Repetition {
  int count = 2;
  std::vector<TerrainPiece> pieces = {};
};

/// Pieces laid end to end along +x from `start_x`, `width` wide about `y` (m). They end at floor
/// level, which determines the height of their beginning.
struct Strip {
  std::vector<TerrainPiece> pieces;
  double start_x = 1.0;
  double y = 0.5;
  double width = 0.9;
};

/// The ground as data: pieces laid end to end along +x from `start_x`. They end at floor level,
/// which determines the height of their beginning. The floor is an infinite plane at z = 0 around
/// them. Without pieces there is only the floor.
struct Terrain {
  std::vector<TerrainPiece> pieces;
  double start_x = -2.0;           ///< where the first piece begins (m)
  double width = 3.0;              ///< extent in y, centred on y = 0 (m)
  int repeat = 1;                  ///< number of times that the list of pieces is repeated
  double friction = 1.0;           ///< sliding friction of every robot–terrain contact
  std::vector<Strip> beside = {};  ///< for example under one wheel; the robot starts on `pieces`
};

/// All strips: first the pieces about y = 0, then those beside them.
std::vector<Strip> strips_of(const Terrain& terrain);

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
