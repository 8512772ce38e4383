#include "core/keys/repeats.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchdown {
namespace {

using ::testing::ElementsAre;

Key key(const std::string& path, const std::string& type = "number") {
  return {.path = path, .type = type, .unit = "", .range = "", .fallback = "0", .meaning = "A."};
}

std::vector<std::string> texts(const std::vector<Key>& keys) {
  std::vector<std::string> texts;
  for (const Key& one : keys) texts.push_back(one.path + ": " + one.type);
  return texts;
}

TEST(RepeatedSections, AreReferencesToTheFirst) {
  EXPECT_THAT(texts(without_repeats({key("hip", "section"), key("hip.a"), key("hip.b"),
                                     key("hip.c"), key("knee", "section"), key("knee.a"),
                                     key("knee.b"), key("knee.c"), key("last")})),
              ElementsAre("hip: section", "hip.a: number", "hip.b: number", "hip.c: number",
                          "knee: section as hip", "last: number"));
}

TEST(RepeatedSections, AreKeptIfAnyTextDiffers) {
  std::vector<Key> keys = {key("hip", "section"),  key("hip.a"),  key("hip.b"),  key("hip.c"),
                           key("knee", "section"), key("knee.a"), key("knee.b"), key("knee.c")};
  keys.back().unit = "m";
  EXPECT_EQ(without_repeats(keys), keys);
}

TEST(RepeatedSections, AreKeptIfTheyAreShort) {
  const std::vector<Key> keys = {key("hip", "section"), key("hip.a"), key("knee", "section"),
                                 key("knee.a")};
  EXPECT_EQ(without_repeats(keys), keys);
}

TEST(RepeatedSections, MayContainThemselves) {
  EXPECT_THAT(
      texts(without_repeats({key("a", "list"), key("a[].x"), key("a[].y"),
                             key("a[].a", "list as a"), key("b", "list"), key("b[].x"),
                             key("b[].y"), key("b[].a", "list as b")})),
      ElementsAre("a: list", "a[].x: number", "a[].y: number", "a[].a: list as a", "b: list as a"));
}

}  // namespace
}  // namespace touchdown
