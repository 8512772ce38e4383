#include "core/yaml.hpp"

#include <functional>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/fields.hpp"
#include "tests/complaint.hpp"

namespace touchdown {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

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

std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return complaint_of([&] { read_yaml(text, overrides); });
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
  EXPECT_THAT(refusal("name: x\ndurration: 2\n"), AllOf(StartsWith("test.yaml:2:1: durration: "),
                                                        HasSubstr("did you mean 'duration'?")));
  EXPECT_THAT(refusal("noise:\n  seed: 2\n"),
              AllOf(StartsWith("test.yaml:2:3: noise.seed: "), HasSubstr("'seeds'")));
  EXPECT_THAT(refusal("runs:\n  - name: a\n  - name: b\n    sped: 1\n"),
              AllOf(StartsWith("test.yaml:4:5: runs.1.sped: "), HasSubstr("'speed'")));
}

TEST(Yaml, AnUnknownKeyThatIsNearToNothingListsTheKnownOnes) {
  EXPECT_THAT(refusal("zzzzzzzz: 1\n"), AllOf(HasSubstr("unknown key"), HasSubstr("duration"),
                                              Not(HasSubstr("did you mean"))));
}

TEST(Yaml, AWrongTypeIsReportedWithTheExpectedTypeAndPosition) {
  EXPECT_THAT(refusal("duration: long\n"),
              AllOf(StartsWith("test.yaml:1:11: duration: "), HasSubstr("a number")));
  EXPECT_THAT(refusal("count: 2.5\n"), HasSubstr("a whole number"));
  EXPECT_THAT(refusal("video: perhaps\n"), HasSubstr("true or false"));
  EXPECT_THAT(refusal("name: [1, 2]\n"), HasSubstr("a text"));
  EXPECT_THAT(refusal("noise:\n  levels: 3\n"), HasSubstr("a list, each item a number"));
  EXPECT_THAT(refusal("noise: 3\n"), HasSubstr("expected a mapping"));
  EXPECT_THAT(refusal("runs: 3\n"), HasSubstr("expected a list"));
  EXPECT_THAT(refusal("runs: [3]\n"), HasSubstr("runs.0: expected a mapping"));
}

TEST(Yaml, AValueOutOfRangeIsReportedWithTheRange) {
  EXPECT_THAT(refusal("duration: -1\n"),
              AllOf(StartsWith("test.yaml:1:11: duration: "), HasSubstr("from 0 to 100")));
  EXPECT_THAT(refusal("count: 11\n"), HasSubstr("from 1 to 10"));
  EXPECT_THAT(refusal("duration: .nan\n"), HasSubstr("from 0 to 100"));
}

TEST(Yaml, AnUnknownChoiceNamesTheNearest) {
  EXPECT_THAT(refusal("engine: mujocco\n"),
              AllOf(StartsWith("test.yaml:1:9: engine: "), HasSubstr("mujoco, bullet"),
                    HasSubstr("did you mean 'mujoco'?")));
}

TEST(Yaml, ARequiredKeyThatIsAbsentIsNamed) {
  EXPECT_THAT(refusal("runs:\n  - speed: 1\n"),
              AllOf(StartsWith("test.yaml:2:5: runs.0.name: "), HasSubstr("missing")));
}

TEST(Yaml, BrokenYamlIsPlaced) {
  EXPECT_THAT(refusal("name: [1, 2\nduration: 3\n"),
              AllOf(StartsWith("test.yaml:"), HasSubstr("not valid YAML")));
  EXPECT_THAT(refusal("name: x\n\tcount: 3\n"), StartsWith("test.yaml:2:"));
}

TEST(Yaml, EmptyFilesAndOtherDocumentsAreNoMappings) {
  for (const char* text : {"", "\n# only a comment\n", "- a\n- b\n", "just text\n"}) {
    EXPECT_THAT(refusal(text), HasSubstr("test.yaml:1:1: expected a mapping")) << text;
  }
}

TEST(Yaml, AMissingFileIsNamed) {
  EXPECT_THAT(complaint_of([] { YamlDocument::load("/nonexistent/stairs.yaml"); }),
              HasSubstr("/nonexistent/stairs.yaml"));
  EXPECT_THROW(YamlDocument::load("/tmp"), InputError);
}

TEST(Yaml, DuplicateKeysAreRefused) {
  EXPECT_THAT(refusal("count: 3\nname: x\ncount: 4\n"),
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
  EXPECT_THAT(refusal(good, {"noise.seedz=5"}),
              AllOf(StartsWith("--set noise.seedz=5: noise.seedz: "), HasSubstr("'seeds'")));
  EXPECT_THAT(refusal(good, {"duration=-2"}),
              StartsWith("--set duration=-2: duration: expected a number from 0"));
}

TEST(YamlOverride, IsNamedInErrorsOfItsValueOnly) {
  EXPECT_THAT(refusal(good, {"noise={seeds: 1, seedz: 5}"}),
              StartsWith("--set noise={seeds: 1, seedz: 5}: noise.seedz: unknown key"));
  EXPECT_THAT(refusal(good, {"duration=1", "duration=-3"}), StartsWith("--set duration=-3: "));
  EXPECT_THAT(refusal("name: x\nduration: -1\n", {"noise.seeds=1"}),
              StartsWith("test.yaml:2:11: duration: "));
}

TEST(YamlOverride, WhatIsNoAssignmentIsRefused) {
  for (const char* assignment : {"duration", "=3", "", "noise..seeds=3", ".=1", "noise.=2"}) {
    EXPECT_THAT(refusal(good, {assignment}), HasSubstr("--set")) << assignment;
  }
  EXPECT_THAT(refusal(good, {"duration=[1"}), HasSubstr("--set duration=[1"));
}

TEST(YamlOverride, ItemsThatAreNotThereAreRefused) {
  EXPECT_THAT(refusal(good, {"runs.2.speed=1"}), HasSubstr("0 to 1"));
  EXPECT_THAT(refusal(good, {"runs.first.speed=1"}), HasSubstr("'first'"));
  EXPECT_THAT(refusal(good, {"runs.-1.speed=1"}), HasSubstr("'-1'"));
  EXPECT_THAT(refusal(good, {"name.first=1"}), HasSubstr("'name' holds no keys"));
  EXPECT_THAT(refusal("runs: []\n", {"runs.0.speed=1"}), HasSubstr("--set"));
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

std::string complaint_about(const std::string& text) {
  return complaint_of([&] { (void)YamlDocument::parse(text, "a.yaml"); });
}

std::string complaint_about_set(const std::string& assignment) {
  YamlDocument document = YamlDocument::parse("a: 1\n", "a.yaml");
  return complaint_of([&] { document.override_value(assignment); });
}

TEST(YamlText, AnAliasInsideItsOwnValueIsRefused) {
  EXPECT_THAT(complaint_about("a: &x [*x]\n"), StartsWith("a.yaml:1:8: an alias is inside"));
  EXPECT_THAT(complaint_about("a: &x {b: 1, c: {d: *x}}\n"), StartsWith("a.yaml:1:21: an alias"));
  EXPECT_THAT(complaint_about("&x\na:\n  - 1\n  - *x\n"), StartsWith("a.yaml:4:5: an alias"));
  EXPECT_THAT(complaint_about_set("a=&x [*x]"), StartsWith("--set a=&x [*x]: an alias"));
}

TEST(YamlText, AliasesOfWhatIsThereAreTaken) {
  const YamlDocument document =
      YamlDocument::parse("a: &x [1, 2]\nb: *x\nc: &x 3\nd: *x\n", "a.yaml");
  EXPECT_EQ(document.root()["b"][1].as<int>(), 2);
  EXPECT_EQ(document.root()["d"].as<int>(), 3);
}

std::string laughs(int levels) {
  std::string text = "a0: &a0 [ha, ha, ha, ha, ha, ha, ha, ha, ha]\n";
  for (int i = 1; i < levels; ++i) {
    text += fmt::format(
        "a{0}: &a{0} [*a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}, *a{1}]\n", i, i - 1);
  }
  return text;
}

TEST(YamlText, ABillionLaughsAreRefusedQuickly) {
  EXPECT_EQ(complaint_about(laughs(4)), "no complaint");
  const std::string complaint = complaint_about(laughs(10));
  EXPECT_THAT(complaint, AllOf(StartsWith("a.yaml:7:"), HasSubstr("1000000 values")));
  // Expansion ends at the limit, so its cost does not depend on what would follow: 9^59 values.
  EXPECT_EQ(complaint_about(laughs(8)), complaint);
  EXPECT_EQ(complaint_about(laughs(60)), complaint);
}

TEST(YamlText, NestingIsLimitedWithAliasesExpanded) {
  const auto lists = [](std::size_t depth) {
    return fmt::format("a: {}{}\n", std::string(depth, '['), std::string(depth, ']'));
  };
  EXPECT_EQ(complaint_about(lists(63)), "no complaint");
  EXPECT_THAT(complaint_about(lists(64)), StartsWith("a.yaml:1:67: nested deeper than 64 levels"));
  EXPECT_THAT(complaint_about(lists(100'000)), HasSubstr("nested deeper"));
  EXPECT_THAT(complaint_about(fmt::format("a: {}", std::string(100'000, '['))),
              HasSubstr("a.yaml:1:"));
  EXPECT_THAT(complaint_about(fmt::format("a: {}", std::string(100'000, '{'))),
              HasSubstr("a.yaml:1:"));
  std::string chain = "a:\n  - &a0 [x]\n";
  for (int i = 1; i < 5000; ++i) chain += fmt::format("  - &a{} [*a{}]\n", i, i - 1);
  EXPECT_THAT(complaint_about(chain), AllOf(StartsWith("a.yaml:63:"), HasSubstr("nested deeper")));
}

TEST(YamlText, BytesThatAreNotUtf8AreShownWithTheirPlace) {
  EXPECT_THAT(complaint_about("name: caf\xe9\n"), StartsWith("a.yaml:1:10: not UTF-8: byte 0xe9"));
  EXPECT_THAT(complaint_about("name: ü\nb: ü\xff\n"),
              StartsWith("a.yaml:2:5: not UTF-8: byte 0xff"));
  EXPECT_THAT(complaint_about("# \xc3\n"), HasSubstr("0xc3"));
  EXPECT_THAT(complaint_about(std::string("\xff\xfe"
                                          "a\0:\0",
                                          6)),
              HasSubstr("a.yaml:1:1: not UTF-8"));
  EXPECT_THAT(complaint_about_set("a=\xff"), HasSubstr("not UTF-8"));
  EXPECT_EQ(complaint_about("\xef\xbb\xbf"
                            "a: 1\n"),
            "no complaint")
      << "a byte order mark is UTF-8";
}

TEST(YamlText, Utf8IsValidatedAsInTheStandard) {
  // Unicode 15, table 3-7: the ends of every row, and one beyond them.
  for (const char* accepted :
       {"", "a", "\x7f", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xe1\x80\x80", "\xec\xbf\xbf",
        "\xed\x9f\xbf", "\xee\x80\x80", "\xef\xbf\xbf", "\xf0\x90\x80\x80", "\xf3\xbf\xbf\xbf",
        "\xf4\x8f\xbf\xbf"}) {
    const std::string text = fmt::format("x{}y", accepted);
    EXPECT_EQ(utf8_size(text), text.size()) << accepted;
  }
  for (const char* bad :
       {"\x80", "\xbf", "\xc0\x80", "\xc1\xbf", "\xc2", "\xc2\x7f", "\xc2\xc0", "\xe0\x9f\xbf",
        "\xe1\x80", "\xe1\x80\x7f", "\xed\xa0\x80", "\xed\xbf\xbf", "\xf0\x8f\xbf\xbf",
        "\xf1\x80\x80", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xfe", "\xff"}) {
    EXPECT_EQ(utf8_size(fmt::format("xü{}", bad)), 3U);
    EXPECT_EQ(utf8_size(fmt::format("xü{}y", bad)), 3U);
  }
  EXPECT_EQ(utf8_size(std::string("a\0b", 3)), 3U);
}

TEST(YamlText, AKeyThatIsNoNameIsRefused) {
  EXPECT_THAT(complaint_about("[a, b]: 1\n"), StartsWith("a.yaml:1:1: expected a name as a key"));
  EXPECT_THAT(complaint_about("a: 1\nb:\n  ? {c: 1}\n  : 2\n"),
              StartsWith("a.yaml:3:5: expected a name"));
  EXPECT_THAT(complaint_about("a: {: 1}\n"), HasSubstr("expected a name"));
  EXPECT_THAT(complaint_about("~: 1\n"), HasSubstr("expected a name"));
  EXPECT_THAT(complaint_about("a: &x b\nc:\n  *x : 1\n"), HasSubstr("expected a name"));
  EXPECT_THAT(complaint_about_set("a={[b]: 1}"), StartsWith("--set a={[b]: 1}: expected a name"));
  EXPECT_EQ(complaint_about("1: a\n\"b c\": d\n? e\n: f\n"), "no complaint");
}

TEST(YamlText, ASecondDocumentIsRefused) {
  EXPECT_THAT(complaint_about("a: 1\n---\na: 2\n"),
              AllOf(StartsWith("a.yaml:2:"), HasSubstr("one YAML")));
  EXPECT_THAT(complaint_about("a: 1\n...\n---\n[x"), HasSubstr("a.yaml:"));
  EXPECT_THAT(complaint_about_set("a=1\n---\n2"), HasSubstr("one YAML document"));
  EXPECT_EQ(complaint_about("%YAML 1.2\n---\na: 1\n...\n"), "no complaint")
      << "the marks of one document";
}

TEST(YamlText, ALeadingZeroIsNeitherOctalNorDecimal) {
  EXPECT_THAT(complaint_about("a: 1\nb: 010\n"),
              StartsWith("a.yaml:2:4: 010: a number has no leading"));
  EXPECT_THAT(complaint_about("a: [1, -08]\n"), StartsWith("a.yaml:1:8: -08"));
  EXPECT_THAT(complaint_about("a: +00\n"), HasSubstr("+00"));
  EXPECT_THAT(complaint_about_set("a=010"), StartsWith("--set a=010: 010: a number has"));
  for (const char* accepted : {"0", "-0", "0.10", "00.5", "10", "0x10", "\"010\"", "'007'", "01a",
                               "0 1", "2020-01-02", "1e05"}) {
    EXPECT_EQ(complaint_about(fmt::format("a: {}\n", accepted)), "no complaint") << accepted;
  }
}

}  // namespace
}  // namespace touchdown
