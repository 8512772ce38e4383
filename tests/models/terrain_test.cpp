#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/fields.hpp"
#include "core/files.hpp"
#include "models/terrain_yaml.hpp"
#include "tests/models/terrains.hpp"

namespace touchdown::models {
namespace {

using ::testing::AllOf;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Terrain read(const std::string& text) {
  return from_yaml<Terrain>(YamlDocument::parse(text, "scene.yaml"));
}

TEST(Terrain, DefaultFlightHasItsEdgesAtWholeMetres) {
  EXPECT_THAT(edges(stairs()),
              ElementsAre(DoubleNear(1, 1e-12), DoubleNear(2, 1e-12), DoubleNear(3, 1e-12),
                          DoubleNear(4, 1e-12), DoubleNear(5, 1e-12), DoubleNear(6, 1e-12),
                          DoubleNear(7, 1e-12)));
}

TEST(Terrain, HeightFallsByOneRisePerTreadAndEndsOnTheFloor) {
  const Terrain terrain = stairs();
  EXPECT_EQ(height_at(terrain, -3.0), 0.0);
  EXPECT_DOUBLE_EQ(height_at(terrain, 0.0), 1.75);
  for (int i = 1; i <= 7; ++i) EXPECT_NEAR(height_at(terrain, i + 0.5), 1.75 - 0.25 * i, 1e-12);
  EXPECT_EQ(height_at(terrain, 7.5), 0.0);
  EXPECT_EQ(height_at(terrain, 100.0), 0.0);
}

TEST(Terrain, NosingIsAQuarterCircle) {
  const Terrain terrain = stairs();
  const double r = 0.025;
  EXPECT_NEAR(height_at(terrain, 1.0 - r), 1.75, 1e-12);
  EXPECT_NEAR(height_at(terrain, 1.0 - r + r / std::sqrt(2.0)), 1.75 - r + r / std::sqrt(2.0),
              1e-12);
  EXPECT_NEAR(height_at(terrain, std::nextafter(1.0, 0.0)), 1.75 - r, 1e-6);
  EXPECT_NEAR(height_at(terrain, 1.0), 1.5, 1e-12);
}

TEST(Terrain, CourseClimbsAndDropsTwicePerLap) {
  const Terrain terrain = course();
  const double ramp = 0.15 / std::tan(8.0 * M_PI / 180.0);
  const double lap = 1.0 + ramp + 1.5 + 1.5;
  const double first = 1.0 + 1.0 + ramp;
  EXPECT_THAT(edges(terrain),
              ElementsAre(DoubleNear(first, 1e-9), DoubleNear(first + 1.5, 1e-9),
                          DoubleNear(first + lap, 1e-9), DoubleNear(first + lap + 1.5, 1e-9)));
  EXPECT_NEAR(height_at(terrain, 2.0 + 0.5 * ramp), 0.075, 1e-12);
  EXPECT_NEAR(height_at(terrain, first + 0.5), 0.12, 1e-12);
  EXPECT_NEAR(height_at(terrain, first + 2.0), 0.0, 1e-12);
}

TEST(Terrain, TwoFlightsInSequenceMakeAHigherLastDrop) {
  const Terrain terrain{.pieces = {Flat{3.0}, StairFlight{.count = 6}, Step{.drop = 0.5}}};
  EXPECT_EQ(edges(terrain).size(), 7u);
  EXPECT_NEAR(height_at(terrain, 0.0), 2.0, 1e-12);
  EXPECT_NEAR(height_at(terrain, 6.5), 0.5, 1e-12);
}

TEST(Terrain, PlatformStandsOnTheGroundAroundIt) {
  const Terrain terrain{.pieces = {Flat{1.0}, Platform{2.0, 0.4, 0.02}, Flat{1.0}}, .start_x = 0};
  EXPECT_EQ(height_at(terrain, 0.5), 0.0);
  EXPECT_NEAR(height_at(terrain, 1.0), 0.4, 1e-12);
  EXPECT_NEAR(height_at(terrain, 2.9), 0.4, 1e-12);
  EXPECT_EQ(height_at(terrain, 3.5), 0.0);
  EXPECT_THAT(edges(terrain), ElementsAre(DoubleNear(3.0, 1e-12)));
}

TEST(Terrain, WithoutPiecesIsTheFloor) {
  EXPECT_EQ(height_at(Terrain{}, 0.3), 0.0);
  EXPECT_TRUE(edges(Terrain{}).empty());
}

TEST(Terrain, GroundBelowTheFloorIsRefused) {
  const Terrain terrain{.pieces = {Flat{1.0}, Step{0.2, 0.0}, Flat{1.0}, Ramp{10.0, 0.3}}};
  EXPECT_THAT([&] { (void)height_at(terrain, 0.0); },
              ThrowsMessage<InputError>(HasSubstr("below the floor")));
}

TEST(Terrain, OfTheDocumentationCanBeBuilt) {
  const std::string text = read_file(TOUCHDOWN_SOURCE_DIR "/docs/reference/scenarios.md");
  const std::string before = "```yaml\nterrain:\n";
  const std::size_t begin = text.find(before);
  ASSERT_NE(begin, std::string::npos);
  const std::string keys =
      text.substr(begin + before.size(), text.find("```\n", begin + 1) - begin - before.size());
  const auto terrain = from_yaml<Terrain>(YamlDocument::parse(keys, "scenarios.md"));
  EXPECT_EQ(terrain.pieces.size(), 6U);
  EXPECT_EQ(terrain.beside.size(), 1U);
}

TEST(Terrain, NosingLargerThanItsStepIsRefused) {
  const Terrain terrain{.pieces = {Flat{1.0}, Step{0.02, 0.025}}};
  EXPECT_THAT([&] { (void)edges(terrain); },
              ThrowsMessage<InputError>(AllOf(HasSubstr("no room"), HasSubstr("nosing_radius"))));
  const Terrain short_tread{.pieces = {Flat{1.0}, StairFlight{3, 0.02, 0.25, 0.025}}};
  EXPECT_THAT([&] { (void)edges(short_tread); }, ThrowsMessage<InputError>(HasSubstr("no room")));
}

TEST(Terrain, RepeatedPartsAreLaidDownInTurn) {
  const Repetition ridges{
      3, {Flat{0.2}, Step{0.01, 0.0}, Repetition{2, {Flat{0.1}}}, Ramp{45.0, 0.01}}};
  const Terrain terrain{.pieces = {Flat{1.0}, ridges, Flat{1.0}, Step{0.05, 0.0}}, .start_x = 0.0};
  EXPECT_THAT(edges(terrain), ElementsAre(DoubleNear(1.2, 1e-9), DoubleNear(1.61, 1e-9),
                                          DoubleNear(2.02, 1e-9), DoubleNear(3.23, 1e-9)));
}

TEST(Terrain, WithTooManySegmentsIsRefused) {
  const Repetition many{1000, {Repetition{1000, {Repetition{1000, {Flat{0.1}}}}}}};
  EXPECT_THAT([&] { (void)edges(Terrain{.pieces = {many}}); },
              ThrowsMessage<InputError>(HasSubstr("more than 10000 segments of ground")));
}

TEST(TerrainYaml, ReadsWhatIsRepeatedAndWhatLiesBeside) {
  const std::string text =
      "pieces:\n  - repeat: {count: 4, pieces: [flat: {length: 0.3}, step: {drop: 0.1}]}\n"
      "beside:\n  - {y: -0.4, width: 0.5, start_x: 2, pieces: [flat: {length: 1}]}\n";
  const Terrain terrain = read(text);
  const auto& ridges = std::get<Repetition>(terrain.pieces.at(0));
  EXPECT_EQ(ridges.count, 4);
  EXPECT_EQ(std::get<Step>(ridges.pieces.at(1)).drop, 0.1);
  ASSERT_EQ(terrain.beside.size(), 1U);
  EXPECT_EQ(terrain.beside[0].y, -0.4);
  EXPECT_EQ(terrain.beside[0].width, 0.5);
  EXPECT_EQ(std::get<Flat>(terrain.beside[0].pieces.at(0)).length, 1.0);
  EXPECT_EQ(YAML::Dump(to_node(read(YAML::Dump(to_node(terrain))))), YAML::Dump(to_node(terrain)));
  EXPECT_THAT(
      [] { read("beside:\n  - {y: 0.4, pieces: [flat: {lenght: 1}]}\n"); },
      ThrowsMessage<InputError>(::testing::AllOf(HasSubstr("scene.yaml:2"), HasSubstr("length"))));
  EXPECT_THAT([] { read("beside:\n  - {y: 0.4}\n"); },
              ThrowsMessage<InputError>(HasSubstr("pieces: is missing")));
  EXPECT_THAT([] { read("beside: [{pieces: [flat: {length: 1}, ramp: {rise: 0.1}]}]\n"); },
              ThrowsMessage<InputError>(HasSubstr("below the floor")));
}

TEST(TerrainYaml, ReadsEveryKindOfPiece) {
  const Terrain terrain = read(
      "start_x: -1\nwidth: 2\nfriction: 0.7\nrepeat: 2\n"
      "pieces:\n  - flat: {length: 2}\n  - stairs: {count: 3, run: 0.8, rise: 0.1}\n"
      "  - ramp: {incline: 10, rise: 0.1}\n  - step: {drop: 0.1, nosing_radius: 0.01}\n"
      "  - platform: {length: 1, height: 0.2}\n");
  ASSERT_EQ(terrain.pieces.size(), 5u);
  EXPECT_EQ(terrain.start_x, -1.0);
  EXPECT_EQ(terrain.repeat, 2);
  EXPECT_EQ(terrain.friction, 0.7);
  EXPECT_EQ(std::get<StairFlight>(terrain.pieces[1]).count, 3);
  EXPECT_EQ(std::get<StairFlight>(terrain.pieces[1]).nosing_radius, 0.025);
  EXPECT_EQ(std::get<Step>(terrain.pieces[3]).nosing_radius, 0.01);
  EXPECT_EQ(std::get<Platform>(terrain.pieces[4]).height, 0.2);
}

TEST(TerrainYaml, WrittenTerrainReadsBackTheSame) {
  for (const Terrain& terrain : {stairs(), course(), Terrain{}}) {
    const YAML::Node node = to_node(terrain);
    const Terrain again = read(YAML::Dump(node));
    EXPECT_EQ(edges(again), edges(terrain));
    EXPECT_EQ(YAML::Dump(to_node(again)), YAML::Dump(node));
  }
}

TEST(TerrainYaml, MistakesAreNamedWithTheirPlace) {
  const auto complaint = [](const std::string& text) { return [text] { (void)read(text); }; };
  EXPECT_THAT(
      complaint("pieces:\n  - flat: {lenght: 2}\n"),
      ThrowsMessage<InputError>(::testing::AllOf(HasSubstr("scene.yaml:2"), HasSubstr("length"))));
  EXPECT_THAT(complaint("pieces:\n  - stairs: {count: 0}\n"),
              ThrowsMessage<InputError>(HasSubstr("count")));
  EXPECT_THAT(complaint("pieces:\n  - stair: {count: 1}\n"),
              ThrowsMessage<InputError>(HasSubstr("stairs")));
  EXPECT_THAT(complaint("pieces:\n  - flat: {length: 2}\n    step: {drop: 1}\n"),
              ThrowsMessage<InputError>(HasSubstr("one of")));
  EXPECT_THAT(complaint("pieces:\n  - flat: {length: .nan}\n"),
              ThrowsMessage<InputError>(HasSubstr("length")));
  EXPECT_THAT(complaint("friction: slippery\n"), ThrowsMessage<InputError>(HasSubstr("number")));
  EXPECT_THAT(complaint("pieces:\n  - ramp: {rise: 0}\n"),
              ThrowsMessage<InputError>(HasSubstr("rise")));
  EXPECT_THAT(complaint("pieces:\n  - step: {drop: 0.1}\n"),
              ThrowsMessage<InputError>(HasSubstr("scene.yaml")));
}

}  // namespace
}  // namespace touchdown::models
