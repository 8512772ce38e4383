#include "core/yaml.hpp"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/fields.hpp"

namespace touchdown {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::string message(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

struct Noise {
  std::vector<double> levels;
  int seeds = 1;
};

struct Run {
  std::string name;
  double speed = 0.0;
};

struct Config {
  std::string name = "default";
  double duration = 1.0;
  int count = 3;
  bool video = true;
  Noise noise;
  std::vector<Run> runs;
  std::size_t engine = 0;
};

void describe(Fields& fields, Run& run) {
  fields.require("name", run.name);
  fields("speed", run.speed);
}

void describe(Fields& fields, Noise& noise) {
  fields("levels", noise.levels);
  fields("seeds", noise.seeds);
}

void describe(Fields& fields, Config& config) {
  fields("name", config.name);
  fields("duration", config.duration, 0.0, 100.0);
  fields("count", config.count, 1, 10);
  fields("video", config.video);
  fields.section("noise", config.noise);
  fields.list("runs", config.runs);
  fields.choose("engine", {"mujoco", "bullet"}, config.engine);
}

Config read_yaml(const YamlDocument& document) { return from_yaml<Config>(document); }

Config read_yaml(const std::string& text, const std::vector<std::string>& overrides = {}) {
  YamlDocument document = YamlDocument::parse(text, "test.yaml");
  for (const std::string& assignment : overrides) document.override_value(assignment);
  return read_yaml(document);
}

std::string complaint_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return message([&] { read_yaml(text, overrides); });
}

constexpr const char* good = R"(name: stairs
duration: 2.5
count: 4
video: false
noise:
  levels: [0, 0.5, 1]
  seeds: 2
runs:
  - name: slow
    speed: 0.4
  - name: fast
engine: bullet
)";

TEST(Yaml, ReadsEveryKindOfValue) {
  const Config config = read_yaml(good);
  EXPECT_EQ(config.name, "stairs");
  EXPECT_EQ(config.duration, 2.5);
  EXPECT_EQ(config.count, 4);
  EXPECT_FALSE(config.video);
  EXPECT_THAT(config.noise.levels, ElementsAre(0.0, 0.5, 1.0));
  EXPECT_EQ(config.noise.seeds, 2);
  ASSERT_EQ(config.runs.size(), 2U);
  EXPECT_EQ(config.runs[0].speed, 0.4);
  EXPECT_EQ(config.runs[1].name, "fast");
  EXPECT_EQ(config.engine, 1U);
}

TEST(Yaml, AbsentKeysKeepTheirDefaults) {
  const Config config = read_yaml("name: x\n");
  EXPECT_EQ(config.duration, 1.0);
  EXPECT_TRUE(config.video);
  EXPECT_TRUE(config.runs.empty());
}

TEST(Yaml, ATypoIsPlacedAndTheNearestKeyNamed) {
  EXPECT_THAT(
      complaint_of("name: x\ndurration: 2\n"),
      AllOf(StartsWith("test.yaml:2:1: durration: "), HasSubstr("did you mean 'duration'?")));
  EXPECT_THAT(complaint_of("noise:\n  seed: 2\n"),
              AllOf(StartsWith("test.yaml:2:3: noise.seed: "), HasSubstr("'seeds'")));
  EXPECT_THAT(complaint_of("runs:\n  - name: a\n  - name: b\n    sped: 1\n"),
              AllOf(StartsWith("test.yaml:4:5: runs.1.sped: "), HasSubstr("'speed'")));
}

TEST(Yaml, AnUnknownKeyThatIsNearToNothingListsTheKnownOnes) {
  EXPECT_THAT(complaint_of("zzzzzzzz: 1\n"), AllOf(HasSubstr("unknown key"), HasSubstr("duration"),
                                                   Not(HasSubstr("did you mean"))));
}

TEST(Yaml, AWrongTypeIsReportedWithTheExpectedTypeAndPosition) {
  EXPECT_THAT(complaint_of("duration: long\n"),
              AllOf(StartsWith("test.yaml:1:11: duration: "), HasSubstr("a number")));
  EXPECT_THAT(complaint_of("count: 2.5\n"), HasSubstr("a whole number"));
  EXPECT_THAT(complaint_of("video: perhaps\n"), HasSubstr("true or false"));
  EXPECT_THAT(complaint_of("name: [1, 2]\n"), HasSubstr("a text"));
  EXPECT_THAT(complaint_of("noise:\n  levels: 3\n"), HasSubstr("a list, each item a number"));
  EXPECT_THAT(complaint_of("noise: 3\n"), HasSubstr("expected a mapping"));
  EXPECT_THAT(complaint_of("runs: 3\n"), HasSubstr("expected a list"));
  EXPECT_THAT(complaint_of("runs: [3]\n"), HasSubstr("runs.0: expected a mapping"));
}

TEST(Yaml, AValueOutOfRangeIsReportedWithTheRange) {
  EXPECT_THAT(complaint_of("duration: -1\n"),
              AllOf(StartsWith("test.yaml:1:11: duration: "), HasSubstr("from 0 to 100")));
  EXPECT_THAT(complaint_of("count: 11\n"), HasSubstr("from 1 to 10"));
  EXPECT_THAT(complaint_of("duration: .nan\n"), HasSubstr("from 0 to 100"));
}

TEST(Yaml, AnUnknownChoiceNamesTheNearest) {
  EXPECT_THAT(complaint_of("engine: mujocco\n"),
              AllOf(StartsWith("test.yaml:1:9: engine: "), HasSubstr("mujoco, bullet"),
                    HasSubstr("did you mean 'mujoco'?")));
}

TEST(Yaml, ARequiredKeyThatIsAbsentIsNamed) {
  EXPECT_THAT(complaint_of("runs:\n  - speed: 1\n"),
              AllOf(StartsWith("test.yaml:2:5: runs.0.name: "), HasSubstr("missing")));
}

TEST(Yaml, BrokenYamlIsPlaced) {
  EXPECT_THAT(complaint_of("name: [1, 2\nduration: 3\n"),
              AllOf(StartsWith("test.yaml:"), HasSubstr("not valid YAML")));
  EXPECT_THAT(complaint_of("name: x\n\tcount: 3\n"), StartsWith("test.yaml:2:"));
}

TEST(Yaml, EmptyFilesAndOtherDocumentsAreNoMappings) {
  for (const char* text : {"", "\n# only a comment\n", "- a\n- b\n", "just text\n"}) {
    EXPECT_THAT(complaint_of(text), HasSubstr("test.yaml:1:1: expected a mapping")) << text;
  }
}

TEST(Yaml, AMissingFileIsNamed) {
  EXPECT_THAT(message([] { YamlDocument::load("/nonexistent/stairs.yaml"); }),
              HasSubstr("/nonexistent/stairs.yaml"));
  EXPECT_THROW(YamlDocument::load("/tmp"), InputError);
}

TEST(Yaml, DuplicateKeysAreRefused) {
  EXPECT_THAT(complaint_of("count: 3\nname: x\ncount: 4\n"),
              AllOf(StartsWith("test.yaml:3:1: count: "), HasSubstr("twice")));
}

TEST(YamlOverride, ReplacesValuesByDottedKeysAndItemNumbers) {
  const Config config = read_yaml(
      good, {"duration=7", "noise.levels=[2, 3]", "noise.seeds=9", "runs.1.speed=0.9", "name=a=b"});
  EXPECT_EQ(config.duration, 7.0);
  EXPECT_THAT(config.noise.levels, ElementsAre(2.0, 3.0));
  EXPECT_EQ(config.noise.seeds, 9);
  EXPECT_EQ(config.runs[1].speed, 0.9);
  EXPECT_EQ(config.runs[0].speed, 0.4);
  EXPECT_EQ(config.name, "a=b");
  EXPECT_THAT(read_yaml(good, {"noise.levels.1=0.75"}).noise.levels, ElementsAre(0.0, 0.75, 1.0));
}

TEST(YamlOverride, AddsKeysThatTheFileLeavesOut) {
  EXPECT_EQ(read_yaml("name: x\n", {"noise.seeds=5"}).noise.seeds, 5);
}

TEST(YamlOverride, AnUnknownKeyIsReportedWhenItIsRead) {
  EXPECT_THAT(complaint_of(good, {"noise.seedz=5"}),
              AllOf(StartsWith("--set noise.seedz=5: noise.seedz: "), HasSubstr("'seeds'")));
  EXPECT_THAT(complaint_of(good, {"duration=-2"}),
              StartsWith("--set duration=-2: duration: expected a number from 0"));
}

TEST(YamlOverride, IsNamedInErrorsOfItsValueOnly) {
  EXPECT_THAT(complaint_of(good, {"noise={seeds: 1, seedz: 5}"}),
              StartsWith("--set noise={seeds: 1, seedz: 5}: noise.seedz: unknown key"));
  EXPECT_THAT(complaint_of(good, {"duration=1", "duration=-3"}), StartsWith("--set duration=-3: "));
  EXPECT_THAT(complaint_of("name: x\nduration: -1\n", {"noise.seeds=1"}),
              StartsWith("test.yaml:2:11: duration: "));
}

TEST(YamlOverride, WhatIsNoAssignmentIsRefused) {
  for (const char* assignment : {"duration", "=3", "", "noise..seeds=3", ".=1", "noise.=2"}) {
    EXPECT_THAT(complaint_of(good, {assignment}), HasSubstr("--set")) << assignment;
  }
  EXPECT_THAT(complaint_of(good, {"duration=[1"}), HasSubstr("--set duration=[1"));
}

TEST(YamlOverride, ItemsThatAreNotThereAreRefused) {
  EXPECT_THAT(complaint_of(good, {"runs.2.speed=1"}), HasSubstr("0 to 1"));
  EXPECT_THAT(complaint_of(good, {"runs.first.speed=1"}), HasSubstr("'first'"));
  EXPECT_THAT(complaint_of(good, {"runs.-1.speed=1"}), HasSubstr("'-1'"));
  EXPECT_THAT(complaint_of(good, {"name.first=1"}), HasSubstr("'name' holds no keys"));
  EXPECT_THAT(complaint_of("runs: []\n", {"runs.0.speed=1"}), HasSubstr("--set"));
}

TEST(YamlOverride, OneDocumentsOverridesDoNotReachAnother) {
  const YamlDocument first = YamlDocument::parse(good, "a.yaml");
  YamlDocument second = YamlDocument::parse(good, "b.yaml");
  second.override_value("duration=9");
  EXPECT_EQ(read_yaml(first).duration, 2.5);
}

TEST(Nearest, FindsTheEntryThatIsFewestEditsAway) {
  EXPECT_EQ(nearest("sede", {"speed", "seed", "noise"}), "seed");
  EXPECT_EQ(nearest("nothing_like_it", {"speed", "seed"}), "");
  EXPECT_EQ(nearest("speed", {}), "");
  EXPECT_EQ(nearest("", {"speed"}), "");
}

}  // namespace
}  // namespace touchdown
