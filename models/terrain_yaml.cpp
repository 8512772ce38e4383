#include "models/terrain_yaml.hpp"

#include "core/fields.hpp"
#include "models/profile.hpp"

namespace touchdown::models {

static void describe(Fields& fields, Flat& flat) { fields("length", flat.length, 1e-3, 1000.0); }

static void describe(Fields& fields, StairFlight& stairs) {
  fields("count", stairs.count, 1, 1000);
  fields("run", stairs.run, 0.02, 100.0);
  fields("rise", stairs.rise, 1e-3, 10.0);
  fields("nosing_radius", stairs.nosing_radius, 0.0, 1.0);
}

static void describe(Fields& fields, Ramp& ramp) {
  fields("incline", ramp.incline, 0.1, 60.0);
  fields("rise", ramp.rise, -10.0, 10.0);
  fields.check(ramp.rise != 0.0, "rise", "expected anything but 0; `flat` is for level ground");
}

static void describe(Fields& fields, Platform& platform) {
  fields("length", platform.length, 0.02, 1000.0);
  fields("height", platform.height, 1e-3, 10.0);
  fields("nosing_radius", platform.nosing_radius, 0.0, 1.0);
}

static void describe(Fields& fields, Step& step) {
  fields("drop", step.drop, 1e-3, 10.0);
  fields("nosing_radius", step.nosing_radius, 0.0, 1.0);
}

static void describe(Fields& fields, TerrainPiece& piece);

static void describe(Fields& fields, Repetition& repetition) {
  fields("count", repetition.count, 1, 1000);
  fields.require("pieces");
  fields.list("pieces", repetition.pieces);
}

/// Describes the piece if it is of this kind.
template <typename Kind>
static void describe_kind(Fields& fields, std::string_view name, TerrainPiece& piece) {
  fields.know(name);
  if (!fields.present(name, std::holds_alternative<Kind>(piece))) return;
  if (fields.reading()) piece = Kind{};
  fields.section(name, std::get<Kind>(piece));
}

static void describe(Fields& fields, TerrainPiece& piece) {
  fields.check(fields.size() == 1, "piece",
               "expected one of flat, stairs, ramp, platform, step, repeat");
  describe_kind<Flat>(fields, "flat", piece);
  describe_kind<StairFlight>(fields, "stairs", piece);
  describe_kind<Ramp>(fields, "ramp", piece);
  describe_kind<Platform>(fields, "platform", piece);
  describe_kind<Step>(fields, "step", piece);
  describe_kind<Repetition>(fields, "repeat", piece);
}

static void describe(Fields& fields, Strip& strip) {
  fields("start_x", strip.start_x, -1000.0, 1000.0);
  fields("y", strip.y, -1000.0, 1000.0);
  fields("width", strip.width, 0.01, 1000.0);
  fields.require("pieces");
  fields.list("pieces", strip.pieces);
  fields.finish();
  fields.check("pieces", [&] { (void)Profile(strip); });
}

void describe(Fields& fields, Terrain& terrain) {
  fields("start_x", terrain.start_x, -1000.0, 1000.0);
  fields("width", terrain.width, 0.1, 1000.0);
  fields("repeat", terrain.repeat, 1, 1000);
  fields("friction", terrain.friction, 0.0, 10.0);
  fields.list("pieces", terrain.pieces);
  fields.list_if_any("beside", terrain.beside);
  fields.finish();
  fields.check("pieces", [&] { (void)Profile(terrain); });
}

}  // namespace touchdown::models
