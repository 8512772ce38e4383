#include "core/fields.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/complaint.hpp"

namespace touchdown {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

enum class Surface : int { rubber, foam };

struct Part {
  double length = 0.5;
  std::vector<Part> parts = {};
};

struct Motor {
  int poles = 14;
};

struct Machine {
  std::string name;
  bool enabled = true;
  double mass = 0.1;
  double reach = std::numeric_limits<double>::infinity();
  std::uint64_t seed = 3;
  std::optional<double> height;
  Surface surface = Surface::foam;
  std::vector<std::string> drives = {"left"};
  std::vector<double> place = {0.0, 1.5};
  Motor motor;
  std::optional<Motor> spare;
  std::vector<Part> parts;
  std::vector<Motor> motors = {{7}, {8}};
};

void describe(Fields& fields, Part& part) {
  fields("length", part.length, 0.0, 2.0).doc("m", "Length.");
  fields.list("parts", part.parts).doc("Parts of the part.");
}

void describe(Fields& fields, Motor& motor) {
  fields("poles", motor.poles, 2, 100).doc("Number of poles.");
  fields.check(motor.poles < 14, "poles", "checks are silent");
}

void describe(Fields& fields, Machine& machine) {
  fields.require("name", machine.name).doc("Name.");
  fields("enabled", machine.enabled).doc("Whether it is on.");
  fields("mass", machine.mass, 0.0, 1e300).doc("kg", "Mass.");
  if (fields.reading() || std::isfinite(machine.reach)) fields("reach", machine.reach, 0.0, 9.0);
  fields("seed", machine.seed).doc("Seed.");
  fields.optional("height", machine.height, 0.5, 1.5).doc("m", "Height.");
  fields.choose("surface", {"rubber", "foam"}, machine.surface).doc("Surface.");
  fields.names("drives", {"left", "right"}, machine.drives).doc("Drives.");
  fields.in_line("place", machine.place).range("two").fallback("anywhere").doc("m", "Place.");
  fields.section("motor", machine.motor).doc("The motor.");
  fields.know("spare");
  fields.section("spare", machine.spare).doc("Another one.");
  fields.list("parts", machine.parts).doc("All parts.");
  fields.require("motors");
  fields.list_if_any("motors", machine.motors).doc("All motors.");
  fields.finish();
}

std::vector<Key> keys() { return documented_keys(Machine()); }

Key documented(const std::string& path) {
  for (const Key& one : keys()) {
    if (one.path == path) return one;
  }
  ADD_FAILURE() << path << " is not documented";
  return {};
}

TEST(DocumentedKeys, AreAllKeysInTheOrderOfTheDescription) {
  std::vector<std::string> paths;
  for (const Key& one : keys()) paths.push_back(one.path);
  EXPECT_THAT(paths,
              ElementsAre("name", "enabled", "mass", "reach", "seed", "height", "surface", "drives",
                          "place", "motor", "motor.poles", "spare", "spare.poles", "parts",
                          "parts[].length", "parts[].parts", "motors", "motors[].poles"));
}

TEST(DocumentedKeys, HaveTypesOfTheirMembers) {
  EXPECT_EQ(documented("name").type, "text");
  EXPECT_EQ(documented("enabled").type, "true/false");
  EXPECT_EQ(documented("mass").type, "number");
  EXPECT_EQ(documented("seed").type, "whole number");
  EXPECT_EQ(documented("surface").type, "one of rubber, foam");
  EXPECT_EQ(documented("drives").type, "list of left, right");
  EXPECT_EQ(documented("place").type, "list of numbers");
  EXPECT_EQ(documented("motor").type, "section");
  EXPECT_EQ(documented("motors").type, "list");
}

TEST(DocumentedKeys, DescribeAListInsideItselfOnce) {
  EXPECT_EQ(documented("parts").type, "list");
  EXPECT_EQ(documented("parts[].parts").type, "list as parts");
}

TEST(DocumentedKeys, HaveTheRangesThatReadingChecks) {
  EXPECT_EQ(documented("motor.poles").range, "2 to 100");
  EXPECT_EQ(documented("mass").range, "≥ 0");
  EXPECT_EQ(documented("seed").range, "");
  EXPECT_EQ(documented("height").range, "0.5 to 1.5");
}

TEST(DocumentedKeys, HaveTheDefaultsThatAreWritten) {
  EXPECT_EQ(documented("enabled").fallback, "true");
  EXPECT_EQ(documented("mass").fallback, "0.1");
  EXPECT_EQ(documented("surface").fallback, "foam");
  EXPECT_EQ(documented("drives").fallback, "[left]");
  EXPECT_EQ(documented("motor.poles").fallback, "14");
  EXPECT_EQ(documented("parts").fallback, "[]");
  EXPECT_EQ(documented("parts[].length").fallback, "0.5");
}

TEST(DocumentedKeys, AreRequiredOrAbsentWithoutADefault) {
  EXPECT_EQ(documented("name").fallback, "required");
  EXPECT_EQ(documented("motors").fallback, "required");
  EXPECT_EQ(documented("height").fallback, "none");
  EXPECT_EQ(documented("reach").fallback, "none");
  EXPECT_EQ(documented("spare").fallback, "none");
  EXPECT_EQ(documented("spare.poles").fallback, "14");
  EXPECT_EQ(documented("motor").fallback, "");
}

TEST(DocumentedKeys, HaveTheNotesOfTheirDescription) {
  EXPECT_EQ(documented("mass").unit, "kg");
  EXPECT_EQ(documented("mass").meaning, "Mass.");
  EXPECT_EQ(documented("spare").meaning, "Another one.");
  EXPECT_EQ(documented("place").range, "two");
  EXPECT_EQ(documented("place").fallback, "anywhere");
}

TEST(DocumentedKeys, AreReadAndWrittenAsWithoutNotes) {
  const YamlDocument document = YamlDocument::parse(
      "{name: a, height: 1, motors: [{poles: 4}], motor: {poles: 2}}", "m.yaml");
  const auto machine = from_yaml<Machine>(document);
  EXPECT_EQ(machine.height, 1.0);
  EXPECT_EQ(to_node(machine)["height"].as<double>(), 1.0);
  EXPECT_FALSE(to_node(Machine())["height"]);
  EXPECT_THAT(
      complaint_of([&] {
        (void)from_yaml<Machine>(YamlDocument::parse("{name: a, motors: [], height: 2}", "m.yaml"));
      }),
      HasSubstr("height: expected a number from 0.5 to 1.5"));
}

TEST(ValueText, IsTheShortestYamlOnOneLine) {
  EXPECT_EQ(value_text(YAML::Node(0.1)), "0.1");
  EXPECT_EQ(value_text(YAML::Node(1.0 / 3.0)), "0.3333333333333333");
  EXPECT_EQ(value_text(YAML::Node(true)), "true");
  EXPECT_EQ(value_text(YAML::Node("")), "\"\"");
  EXPECT_EQ(value_text(YAML::Node(std::vector<double>{})), "[]");
  EXPECT_EQ(value_text(YAML::Load("[{a: 1.50, b: [x, y]}]")), "[{a: 1.5, b: [x, y]}]");
}

TEST(ValueText, OfANumberThatIsNotFiniteIsNone) {
  EXPECT_EQ(value_text(YAML::Load(".inf")), "none");
  EXPECT_EQ(value_text(YAML::Load(".nan")), "none");
}

TEST(RangeText, LeavesOutALimitThatOnlyExcludesAbsurdNumbers) {
  EXPECT_EQ(range_text(-1.0, 0.5), "-1 to 0.5");
  EXPECT_EQ(range_text(0.0, 1e15), "≥ 0");
}

enum class Colour : int { red, green };

struct Wheel {
  std::string name;
  double radius = 0.05;
};

struct Engine {
  int power = 10;
};

struct Car {
  std::string owner;
  Colour colour = Colour::red;
  std::vector<double> place = {0.0, 1.5};
  std::vector<std::string> drivers = {"ann"};
  Engine engine;
  std::optional<Engine> spare;
  std::vector<Wheel> wheels;
  std::vector<Wheel> more_wheels;
};

void describe(Fields& fields, Wheel& wheel) {
  fields.require("name", wheel.name);
  fields("radius", wheel.radius, 0.01, 1.0);
}

void describe(Fields& fields, Engine& engine) { fields("power", engine.power, 1, 100); }

void describe(Fields& fields, Car& car) {
  fields("owner", car.owner);
  fields.choose("colour", {"red", "green"}, car.colour);
  fields.in_line("place", car.place);
  fields.check(car.place.size() == 2, "place", "expected two numbers");
  fields.names("drivers", {"ann", "bob"}, car.drivers);
  fields.section("engine", car.engine);
  fields.section("spare", car.spare);
  fields.list("wheels", car.wheels);
  fields.list_if_any("more_wheels", car.more_wheels);
  fields.check("owner", [&] {
    if (car.owner == "none") throw InputError("expected a person");
  });
}

Car read(const std::string& text) { return from_yaml<Car>(YamlDocument::parse(text, "car.yaml")); }

std::string complaint(const std::string& text) {
  return complaint_of([&] { (void)read(text); });
}

TEST(Fields, WriteEveryDefaultInTheOrderOfTheDescription) {
  EXPECT_EQ(YAML::Dump(to_node(Car{})),
            "owner: \"\"\ncolour: red\nplace: [0, 1.5]\ndrivers:\n  - ann\n"
            "engine:\n  power: 10\nwheels:\n  []");
}

TEST(Fields, ReadBackWhatTheyWrite) {
  const Car car = read(
      "{owner: bob, colour: green, place: [1, 2], drivers: [bob, ann], engine: {power: 7}, "
      "spare: {}, wheels: [{name: left, radius: 0.1}], more_wheels: [{name: right}]}");
  EXPECT_EQ(car.colour, Colour::green);
  EXPECT_THAT(car.drivers, ElementsAre("bob", "ann"));
  EXPECT_EQ(car.engine.power, 7);
  ASSERT_TRUE(car.spare.has_value());
  EXPECT_EQ(car.spare->power, 10);
  ASSERT_EQ(car.wheels.size(), 1U);
  EXPECT_EQ(car.wheels.front().radius, 0.1);
  const std::string text = YAML::Dump(to_node(car));
  EXPECT_THAT(text, AllOf(HasSubstr("spare:"), HasSubstr("more_wheels:")));
  EXPECT_EQ(YAML::Dump(to_node(read(text))), text);
}

TEST(Fields, AListThatIsThereReplacesTheDefault) {
  Car car;
  car.wheels = {{"left"}, {"right"}};
  const YamlDocument document = YamlDocument::parse("wheels: [{name: only}]", "car.yaml");
  const YamlDocument without = YamlDocument::parse("owner: bob", "car.yaml");
  EXPECT_EQ(from_yaml(document, car).wheels.size(), 1U);
  EXPECT_EQ(from_yaml(without, car).wheels.size(), 2U);
}

TEST(Fields, ComplainWithTheirPlace) {
  EXPECT_THAT(complaint("engine:\n  power: 0\n"),
              AllOf(StartsWith("car.yaml:2:10: engine.power: "), HasSubstr("from 1 to 100")));
  EXPECT_THAT(complaint("engine:\n  pover: 1\n"), HasSubstr("did you mean 'power'?"));
  EXPECT_THAT(complaint("wheels:\n  - {radius: 0.1}\n"), HasSubstr("wheels.0.name: is missing"));
  EXPECT_THAT(complaint("place: [1]\n"),
              AllOf(StartsWith("car.yaml:1:8: place: "), HasSubstr("two numbers")));
  EXPECT_THAT(complaint("colour: gren\n"), HasSubstr("did you mean 'green'?"));
  EXPECT_THAT(complaint("owner: none\n"), HasSubstr("car.yaml:1:8: owner: expected a person"));
}

TEST(Fields, ListWhatIsKnownOnceWhereNothingIsNear) {
  EXPECT_THAT(complaint("xyzzyxyzzy: 1\n"),
              AllOf(HasSubstr("unknown key (known: owner, colour, place, "),
                    EndsWith(", wheels, more_wheels)")));
}

TEST(Fields, NamesAreKnownDifferentAndNotNone) {
  EXPECT_THAT(complaint("drivers: []\n"), HasSubstr("at least one name"));
  EXPECT_THAT(complaint("drivers: [bop]\n"),
              HasSubstr("'bop' is not one of ann, bob (did you mean 'bob'?)"));
  EXPECT_THAT(complaint("drivers: [bob, bob]\n"),
              AllOf(StartsWith("car.yaml:1:16: drivers: "), HasSubstr("'bob' appears twice")));
}

TEST(Fields, ANumberBetweenQuotesHasNoLeadingZeroEither) {
  EXPECT_EQ(complaint("engine: {power: \"010\"}\n"),
            "car.yaml:1:17: engine.power: 010: a number has no leading zero");
  EXPECT_EQ(complaint("owner: '010'\nplace: [1, '-08']\n"),
            "car.yaml:2:12: place: -08: a number has no leading zero");
  EXPECT_EQ(read("owner: \"010\"\nengine: {power: \"10\"}\n").owner, "010");
}

TEST(Fields, RefuseNumbersThatNoQuantityReaches) {
  // Keys without a range of their own, alone and in lists.
  for (const char* const number : {".nan", ".inf", "-.inf", "1e300", "-1e16", "1e308"}) {
    EXPECT_THAT(complaint(fmt::format("place: [0, {}]", number)),
                AllOf(StartsWith("car.yaml:1:8: place: "), HasSubstr("expected a finite number")))
        << number;
  }
  EXPECT_THAT(complaint("wheels: [{name: a, radius: .nan}]"), HasSubstr("radius: expected"));
  EXPECT_EQ(complaint("place: [1e15, -1e-300]"), "no complaint");
}

}  // namespace
}  // namespace touchdown
