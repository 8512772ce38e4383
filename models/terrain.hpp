#pragma once

#include <variant>
#include <vector>

namespace touchdown::models {

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

struct Repetition;

using TerrainPiece = std::variant<Flat, StairFlight, Ramp, Platform, Step, Repetition>;

/// Pieces that are laid down `count` times.
struct Repetition {
  int count = 2;
  std::vector<TerrainPiece> pieces = {};
};

/// Pieces laid end to end along +x from `start_x`, `width` wide about `y` (m). Their end is level
/// with the floor; the height at which they begin follows.
struct Strip {
  std::vector<TerrainPiece> pieces;
  double start_x = 1.0;
  double y = 0.5;
  double width = 0.9;
};

/// What the robot rolls over, as data: pieces laid end to end along +x from `start_x`. Their end is
/// level with the floor, an infinite plane at z = 0 that lies everywhere else; the height at which
/// they begin follows. No pieces: the floor alone.
struct Terrain {
  std::vector<TerrainPiece> pieces;
  double start_x = -2.0;           ///< where the first piece begins (m)
  double width = 3.0;              ///< extent in y, centred on y = 0 (m)
  int repeat = 1;                  ///< the list of pieces is laid down this many times
  double friction = 1.0;           ///< sliding friction of every robot–terrain contact
  std::vector<Strip> beside = {};  ///< under one wheel alone, say; the robot starts on the pieces
};

/// The pieces about y = 0 first, then those beside them.
std::vector<Strip> strips_of(const Terrain& terrain);

}  // namespace touchdown::models
