
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/fields.hpp"
#include "core/yaml.hpp"

namespace touchdown {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string complaint_about(const std::string& text) {
  try {
    (void)YamlDocument::parse(text, "a.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string complaint_about_set(const std::string& assignment) {
  YamlDocument document = YamlDocument::parse("a: 1\n", "a.yaml");
  try {
    document.override_value(assignment);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
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
  EXPECT_EQ(complaint_about(laughs(4)), "");
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
  EXPECT_EQ(complaint_about(lists(63)), "");
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
            "")
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
  EXPECT_EQ(complaint_about("1: a\n\"b c\": d\n? e\n: f\n"), "");
}

TEST(YamlText, ASecondDocumentIsRefused) {
  EXPECT_THAT(complaint_about("a: 1\n---\na: 2\n"),
              AllOf(StartsWith("a.yaml:2:"), HasSubstr("one YAML")));
  EXPECT_THAT(complaint_about("a: 1\n...\n---\n[x"), HasSubstr("a.yaml:"));
  EXPECT_THAT(complaint_about_set("a=1\n---\n2"), HasSubstr("one YAML document"));
  EXPECT_EQ(complaint_about("%YAML 1.2\n---\na: 1\n...\n"), "") << "the marks of one document";
}

TEST(YamlText, ALeadingZeroIsNeitherOctalNorDecimal) {
  EXPECT_THAT(complaint_about("a: 1\nb: 010\n"),
              StartsWith("a.yaml:2:4: 010: a number has no leading"));
  EXPECT_THAT(complaint_about("a: [1, -08]\n"), StartsWith("a.yaml:1:8: -08"));
  EXPECT_THAT(complaint_about("a: +00\n"), HasSubstr("+00"));
  EXPECT_THAT(complaint_about_set("a=010"), StartsWith("--set a=010: 010: a number has"));
  for (const char* accepted : {"0", "-0", "0.10", "00.5", "10", "0x10", "\"010\"", "'007'", "01a",
                               "0 1", "2020-01-02", "1e05"}) {
    EXPECT_EQ(complaint_about(fmt::format("a: {}\n", accepted)), "") << accepted;
  }
}

}  // namespace
}  // namespace touchdown
