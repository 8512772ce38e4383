#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/fields.hpp"

namespace touchdown {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

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
  try {
    (void)from_yaml<Machine>(YamlDocument::parse("{name: a, motors: [], height: 2}", "m.yaml"));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("height: expected a number from 0.5 to 1.5"));
  }
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

}  // namespace
}  // namespace touchdown
