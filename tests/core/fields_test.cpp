#include "core/fields.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/complaint.hpp"

namespace touchdown {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
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

TEST(DocumentedKeys, HaveTypesRangesAndDefaults) {
  struct Documented {
    std::string path, type, range, fallback;
  };
  for (const auto& [path, type, range, fallback] :
       std::vector<Documented>{{"name", "text", "", "required"},
                               {"enabled", "true/false", "", "true"},
                               {"mass", "number", "≥ 0", "0.1"},
                               {"reach", "number", "0 to 9", "none"},
                               {"seed", "whole number", "", "3"},
                               {"height", "number", "0.5 to 1.5", "none"},
                               {"surface", "one of rubber, foam", "", "foam"},
                               {"drives", "list of left, right", "", "[left]"},
                               {"place", "list of numbers", "two", "anywhere"},
                               {"motor", "section", "", ""},
                               {"motor.poles", "whole number", "2 to 100", "14"},
                               {"spare", "section", "", "none"},
                               {"spare.poles", "whole number", "2 to 100", "14"},
                               {"parts", "list", "", "[]"},
                               {"parts[].length", "number", "0 to 2", "0.5"},
                               {"parts[].parts", "list as parts", "", "[]"},
                               {"motors", "list", "", "required"}}) {
    EXPECT_EQ(documented(path).type, type) << path;
    EXPECT_EQ(documented(path).range, range) << path;
    EXPECT_EQ(documented(path).fallback, fallback) << path;
  }
  EXPECT_EQ(documented("mass").unit, "kg");
  EXPECT_EQ(documented("mass").meaning, "Mass.");
  EXPECT_EQ(documented("spare").meaning, "Another one.");
  EXPECT_EQ(range_text(-1.0, 0.5), "-1 to 0.5");
  EXPECT_EQ(range_text(0.0, 1e15), "≥ 0") << "without a limit that only excludes absurd numbers";
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
  EXPECT_EQ(value_text(YAML::Load(".inf")), "none");
  EXPECT_EQ(value_text(YAML::Load(".nan")), "none");
  EXPECT_EQ(value_text(YAML::Load("[{a: 1.50, b: [x, y]}]")), "[{a: 1.5, b: [x, y]}]");
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

TEST(Fields, RefuseWithPlaceKeyAndExpectation) {
  expect_refused({{"engine:\n  power: 0\n", {"^car.yaml:2:10: engine.power: ", "from 1 to 100"}},
                  {"engine:\n  pover: 1\n", {"did you mean 'power'?"}},
                  {"wheels:\n  - {radius: 0.1}\n", {"wheels.0.name: is missing"}},
                  {"place: [1]\n", {"^car.yaml:1:8: place: ", "two numbers"}},
                  {"colour: gren\n", {"did you mean 'green'?"}},
                  {"owner: none\n", {"car.yaml:1:8: owner: expected a person"}},
                  {"xyzzyxyzzy: 1\n",
                   {"unknown key (known: owner, colour, place, ", ", wheels, more_wheels)"}},
                  {"drivers: []\n", {"at least one name"}},
                  {"drivers: [bop]\n", {"'bop' is not one of ann, bob (did you mean 'bob'?)"}},
                  {"drivers: [bob, bob]\n", {"^car.yaml:1:16: drivers: ", "'bob' appears twice"}},
                  {"engine: {power: \"010\"}\n",
                   {"^car.yaml:1:17: engine.power: 010: a number has no leading zero"}},
                  {"owner: '010'\nplace: [1, '-08']\n",
                   {"^car.yaml:2:12: place: -08: a number has no leading zero"}}},
                 read);
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
