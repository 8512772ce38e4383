#include "core/yaml.hpp"

#include <functional>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/fields.hpp"
#include "core/terminal_text.hpp"
#include "tests/complaint.hpp"

namespace touchdown {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
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
  EXPECT_EQ(read_yaml("name: x\n").duration, 1.0) << "absent keys keep their defaults";
}

TEST(Yaml, IsRefusedWithPlaceKeyAndExpectation) {
  expect_refused(
      {{"name: x\ndurration: 2\n", {"^test.yaml:2:1: durration: ", "did you mean 'duration'?"}},
       {"noise:\n  seed: 2\n", {"^test.yaml:2:3: noise.seed: ", "'seeds'"}},
       {"runs:\n  - name: a\n  - name: b\n    sped: 1\n",
        {"^test.yaml:4:5: runs.1.sped: ", "'speed'"}},
       {"zzzzzzzz: 1\n", {"unknown key (known: name, duration, "}},  // near to nothing
       {"duration: long\n", {"^test.yaml:1:11: duration: ", "a number"}},
       {"count: 2.5\n", {"a whole number"}},
       {"video: perhaps\n", {"true or false"}},
       {"name: [1, 2]\n", {"a text"}},
       {"noise:\n  levels: 3\n", {"a list, each item a number"}},
       {"noise: 3\n", {"expected a mapping"}},
       {"runs: 3\n", {"expected a list"}},
       {"runs: [3]\n", {"runs.0: expected a mapping"}},
       {"duration: -1\n", {"^test.yaml:1:11: duration: ", "from 0 to 100"}},
       {"count: 11\n", {"from 1 to 10"}},
       {"duration: .nan\n", {"from 0 to 100"}},
       {"engine: mujocco\n",
        {"^test.yaml:1:9: engine: ", "mujoco, bullet", "did you mean 'mujoco'?"}},
       {"runs:\n  - speed: 1\n", {"^test.yaml:2:5: runs.0.name: ", "missing"}},
       {"count: 3\nname: x\ncount: 4\n", {"^test.yaml:3:1: count: ", "twice"}},
       {"name: [1, 2\nduration: 3\n", {"^test.yaml:", "not valid YAML"}},
       {"name: x\n\tcount: 3\n", {"^test.yaml:2:"}},
       {"", {"test.yaml:1:1: expected a mapping"}},
       {"\n# only a comment\n", {"test.yaml:1:1: expected a mapping"}},
       {"- a\n- b\n", {"test.yaml:1:1: expected a mapping"}},
       {"just text\n", {"test.yaml:1:1: expected a mapping"}}},
      [](const std::string& text) { return read_yaml(text); });
  expect_refused({{"/nonexistent/stairs.yaml", {"/nonexistent/stairs.yaml"}}, {"/tmp", {"/tmp"}}},
                 YamlDocument::load);
}

TEST(YamlOverride, IsRefusedByItsOwnText) {
  expect_refused({{"noise.seedz=5", {"^--set noise.seedz=5: noise.seedz: ", "'seeds'"}},
                  {"duration=-2", {"^--set duration=-2: duration: expected a number from 0"}},
                  {"noise={seeds: 1, seedz: 5}",
                   {"^--set noise={seeds: 1, seedz: 5}: noise.seedz: unknown key"}},
                  {"duration", {"--set"}},
                  {"=3", {"--set"}},
                  {"", {"--set"}},
                  {"noise..seeds=3", {"--set"}},
                  {".=1", {"--set"}},
                  {"noise.=2", {"--set"}},
                  {"duration=[1", {"--set duration=[1"}},
                  {"runs.2.speed=1", {"0 to 1"}},
                  {"runs.first.speed=1", {"'first'"}},
                  {"runs.-1.speed=1", {"'-1'"}},
                  {"name.first=1", {"'name' holds no keys"}},
                  {"name=&x [*x]", {"^--set name=&x [*x]: an alias"}},
                  {"name=\xff", {"not UTF-8"}},
                  {"name={[b]: 1}", {"^--set name={[b]: 1}: expected a name"}},
                  {"name=010", {"^--set name=010: 010: a number has"}}},
                 [](const std::string& assignment) { return read_yaml(good, {assignment}); });
  EXPECT_THAT(complaint_of([] { (void)read_yaml(good, {"name=1\n---\n2"}); }),
              HasSubstr("one YAML document"));
  expect_refused({{"duration=-3", {"^--set duration=-3: "}}}, [](const std::string& last) {
    return read_yaml(good, {"duration=1", last});
  });
  expect_refused({{"name: x\nduration: -1\n", {"^test.yaml:2:11: duration: "}},  // not its value
                  {"runs: []\n", {"--set"}}},
                 [](const std::string& text) {
                   return read_yaml(text,
                                    {text == "runs: []\n" ? "runs.0.speed=1" : "noise.seeds=1"});
                 });
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
  EXPECT_EQ(read_yaml("name: x\n", {"noise.seeds=5"}).noise.seeds, 5) << "a key that was left out";
}

TEST(YamlOverride, ReplacesNoEarlierOne) {
  const auto refused = [](const std::vector<std::string>& assignments) {
    return complaint_of([&] { (void)read_yaml(good, assignments); });
  };
  EXPECT_THAT(refused({"duration=1", "name=x", "duration=2"}),
              HasSubstr("--set duration=2: would replace --set duration=1: give one of them"));
  EXPECT_THAT(refused({"runs.1.speed=1", "runs.1.speed=1"}), HasSubstr("would replace"));
  EXPECT_THAT(refused({"runs.1.speed=1", "runs=[]"}),
              HasSubstr("--set runs=[]: would replace --set runs.1.speed=1"));
  // What is nested in an earlier one completes it.
  EXPECT_EQ(refused({"runs=[{name: a}]", "runs.0.speed=1", "duration=1", "noise.seeds=3"}),
            "no complaint");
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

TEST(YamlText, IsRefusedWithThePlaceInTheText) {
  expect_refused({{"a: &x [*x]\n", {"^a.yaml:1:8: an alias is inside"}},
                  {"a: &x {b: 1, c: {d: *x}}\n", {"^a.yaml:1:21: an alias"}},
                  {"&x\na:\n  - 1\n  - *x\n", {"^a.yaml:4:5: an alias"}},
                  {"name: caf\xe9\n", {"^a.yaml:1:10: not UTF-8: byte 0xe9"}},
                  {"name: ü\nb: ü\xff\n", {"^a.yaml:2:5: not UTF-8: byte 0xff"}},
                  {"# \xc3\n", {"0xc3"}},
                  {std::string("\xff\xfe"
                               "a\0:\0",
                               6),
                   {"a.yaml:1:1: not UTF-8"}},
                  {"[a, b]: 1\n", {"^a.yaml:1:1: expected a name as a key"}},
                  {"a: 1\nb:\n  ? {c: 1}\n  : 2\n", {"^a.yaml:3:5: expected a name"}},
                  {"a: {: 1}\n", {"expected a name"}},
                  {"~: 1\n", {"expected a name"}},
                  {"a: &x b\nc:\n  *x : 1\n", {"expected a name"}},
                  {"a: 1\n---\na: 2\n", {"^a.yaml:2:", "one YAML"}},
                  {"a: 1\n...\n---\n[x", {"a.yaml:"}},
                  {"a: 1\nb: 010\n", {"^a.yaml:2:4: 010: a number has no leading"}},
                  {"a: [1, -08]\n", {"^a.yaml:1:8: -08"}},
                  {"a: +00\n", {"+00"}},
                  {"a: 1\nb: \"x\\e[31m\"\n", {"^a.yaml:2:4: 'x\\x1b[31m': a text has no"}},
                  {"a: [gnp\xe2\x80\xae.exe]\n", {"^a.yaml:1:5: 'gnp\\u202e.exe'"}},
                  {"\"a\\a\": 1\n", {"^a.yaml:1:1: 'a\\x07'"}}},
                 [](const std::string& text) { return YamlDocument::parse(text, "a.yaml"); });
}

TEST(YamlText, IsTakenWhereItOnlyLooksUnusual) {
  for (const char* text :
       {"1: a\n\"b c\": d\n? e\n: f\n", "%YAML 1.2\n---\na: 1\n...\n", "\xef\xbb\xbfkey: 1\n",
        "a: &x [1, 2]\nb: *x\nc: &x 3\nd: *x\n", "a: |\n  x\n  \ty\nb: \"Ü\\n∠\"\n"}) {
    EXPECT_EQ(complaint_about(text), "no complaint") << text;
  }
  for (const char* number : {"0", "-0", "0.10", "00.5", "10", "0x10", "\"010\"", "'007'", "01a",
                             "0 1", "2020-01-02", "1e05"}) {
    EXPECT_EQ(complaint_about(fmt::format("a: {}\n", number)), "no complaint") << number;
  }
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

}  // namespace
}  // namespace touchdown
