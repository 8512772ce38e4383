#include "core/fields.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

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
  try {
    (void)read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
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
  EXPECT_EQ(complaint("place: [1e15, -1e-300]"), "nothing was thrown");
}

}  // namespace
}  // namespace touchdown
