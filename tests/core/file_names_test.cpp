#include "core/file_names.hpp"

#include <string>

#include <gtest/gtest.h>

namespace touchdown {
namespace {

TEST(NameWord, IsOneWordThatLeadsNowhereElse) {
  for (const char* good : {"stairs", "stairs_authors", "-3", "Größe", "a,b", "日本"}) {
    EXPECT_TRUE(is_name_word(good)) << good;
  }
  EXPECT_TRUE(is_name_word(std::string(100, 'x')));
}

TEST(NameWord, IsNothingThatLeadsElsewhereOrMovesATerminal) {
  for (const std::string bad :
       {"", ".", "..", "../x", "a/b", "/etc", "a\\b", ".hidden", "a b", "a\tb", "a\nb", "a\rb",
        "a\x1b[31m", "a\x7f", "a\xc2\x9b", "stairs.yaml"}) {
    EXPECT_FALSE(is_name_word(bad)) << bad;
  }
  EXPECT_FALSE(is_name_word(std::string("a\0b", 3)));
  EXPECT_FALSE(is_name_word(std::string(101, 'x')));
}

TEST(PartName, IsRecognisedAndKeepsTheExtension) {
  const std::filesystem::path file = part_path("folder/success.csv");
  EXPECT_EQ(file.parent_path(), "folder");
  EXPECT_EQ(file.extension(), ".csv");
  EXPECT_TRUE(is_part_file_name(file.filename())) << file;
  EXPECT_TRUE(is_part_file_name(part_path("key").filename()));
  EXPECT_TRUE(is_part_folder_name(part_folder_path("folder/success_mujoco").filename()));
  EXPECT_NE(part_path("a"), part_path("a"));
}

TEST(PartName, IsNotMistakenForOtherHiddenNames) {
  for (const char* name : {".part", ".my.part.notes", ".config.part", "success.12.0123abcd.part",
                           ".a.partition", ".film.12.part.mkv", ".film.part.12.0123abcd",
                           ".film.12.0123abcd.part.tar.gz", ".film.12.0123abcd.parts"}) {
    EXPECT_FALSE(is_part_file_name(name)) << name;
    EXPECT_FALSE(is_part_folder_name(name)) << name;
  }
}

}  // namespace
}  // namespace touchdown
