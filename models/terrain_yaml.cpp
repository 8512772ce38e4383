#include "core/fields.hpp"
#include "models/profile.hpp"
#include "models/terrain.hpp"

namespace touchdown::models {

static void describe(Fields& fields, Flat& flat) {
  fields("length", flat.length, 1e-3, 1000.0).doc("m", "Length along the course.");
}

static void describe(Fields& fields, StairFlight& stairs) {
  fields("count", stairs.count, 1, 1000).doc("Number of steps down.");
  fields("run", stairs.run, 0.02, 100.0).doc("m", "Length of each tread.");
  fields("rise", stairs.rise, 1e-3, 10.0).doc("m", "Height of each step.");
  fields("nosing_radius", stairs.nosing_radius, 0.0, 1.0).doc("m", "Radius of the rounded edges.");
}

static void describe(Fields& fields, Ramp& ramp) {
  fields("incline", ramp.incline, 0.1, 60.0).doc("°", "Slope.");
  fields("rise", ramp.rise, -10.0, 10.0)
      .range("-10 to 10, not 0")
      .doc("m", "Height at the end; negative: down.");
  fields.check(ramp.rise != 0.0, "rise", "expected anything but 0; `flat` is for level ground");
}

static void describe(Fields& fields, Platform& platform) {
  fields("length", platform.length, 0.02, 1000.0).doc("m", "Length of the top.");
  fields("height", platform.height, 1e-3, 10.0).doc("m", "Height of the vertical front.");
  fields("nosing_radius", platform.nosing_radius, 0.0, 1.0)
      .doc("m", "Radius of the rounded edge at the end.");
}

static void describe(Fields& fields, Step& step) {
  fields("drop", step.drop, 1e-3, 10.0).doc("m", "Height of the edge.");
  fields("nosing_radius", step.nosing_radius, 0.0, 1.0).doc("m", "Radius of the rounded edge.");
}

static void describe(Fields& fields, TerrainPiece& piece);

static void describe(Fields& fields, Repetition& repetition) {
  fields("count", repetition.count, 1, 1000).doc("Number of repetitions.");
  fields.require("pieces");
  fields.list("pieces", repetition.pieces).doc("Pieces in the order of the course.");
}

/// Describes the piece if it is of this kind.
template <typename Kind>
static KeyNotes describe_kind(Fields& fields, std::string_view name, TerrainPiece& piece) {
  if (!fields.given(name, std::holds_alternative<Kind>(piece))) return {};
  if (fields.reading()) piece = Kind{};
  return fields.section(name, std::get<Kind>(piece)).fallback("none");
}

static void describe(Fields& fields, TerrainPiece& piece) {
  fields.check(fields.size() == 1, "piece",
               "expected one of flat, stairs, ramp, platform, step, repeat");
  describe_kind<Flat>(fields, "flat", piece).doc("Level ground.");
  describe_kind<StairFlight>(fields, "stairs", piece).doc("A flight of stairs going down.");
  describe_kind<Ramp>(fields, "ramp", piece).doc("A slope up or down.");
  describe_kind<Platform>(fields, "platform", piece)
      .doc("A block on the ground, with a vertical front.");
  describe_kind<Step>(fields, "step", piece).doc("One edge; the ground after it is lower.");
  describe_kind<Repetition>(fields, "repeat", piece).doc("Pieces that are repeated.");
}

static void describe(Fields& fields, Strip& strip) {
  fields("start_x", strip.start_x, -1000.0, 1000.0).doc("m", "Where the first piece begins.");
  fields("y", strip.y, -1000.0, 1000.0).doc("m", "Middle of the strip across the course.");
  fields("width", strip.width, 0.01, 1000.0).doc("m", "Width across the course.");
  fields.require("pieces");
  fields.list("pieces", strip.pieces).doc("Pieces in the order of the course.");
  fields.finish();
  fields.check("pieces", [&] { (void)Profile(strip); });
}

void describe(Fields& fields, Terrain& terrain) {
  fields("start_x", terrain.start_x, -1000.0, 1000.0).doc("m", "Where the first piece begins.");
  fields("width", terrain.width, 0.1, 1000.0)
      .doc("m", "Width across the course, centred on y = 0.");
  fields("repeat", terrain.repeat, 1, 1000).doc("How often the list of pieces is repeated.");
  fields("friction", terrain.friction, 0.0, 10.0)
      .doc("Sliding friction between robot and terrain.");
  fields.list("pieces", terrain.pieces)
      .doc("Pieces in the order of the course; each has one of the keys below.");
  fields.list_if_any("beside", terrain.beside)
      .doc("Strips of pieces beside the course, for example under one wheel.");
  fields.finish();
  fields.check("pieces", [&] { (void)Profile(terrain); });
}

}  // namespace touchdown::models
