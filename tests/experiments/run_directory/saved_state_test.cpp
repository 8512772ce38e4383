#include "experiments/run_directory/saved_state.hpp"

#include <gtest/gtest.h>

#include "core/files.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::experiments {
namespace {

/// Bytes of every kind, line ends and zeros among them.
std::string bytes(std::size_t size) {
  std::string content;
  for (std::size_t i = 0; i < size; ++i) content += static_cast<char>(i * 37 % 256);
  return content;
}

TEST(SavedState, ComesBackUnderItsOwnKeyOnly) {
  const ScratchFolder folder;
  const auto file = folder / "part";
  for (const std::size_t size : {0U, 1U, 31U, 32U, 1000U}) {
    write_state(file, "experiment a build b", bytes(size));
    EXPECT_EQ(read_state(file, "experiment a build b"), bytes(size));
    EXPECT_EQ(read_state(file, "experiment a build c"), std::nullopt);
    EXPECT_EQ(read_state(file, ""), std::nullopt);
  }
  EXPECT_EQ(read_state(folder / "other", "experiment a build b"), std::nullopt);
  EXPECT_EQ(read_state(folder.path(), "experiment a build b"), std::nullopt);
}

TEST(SavedState, IsRejectedWhenPartOfItIsMissingOrWrong) {
  const ScratchFolder folder;
  const auto file = folder / "part";
  write_state(file, "key", bytes(200));
  const std::string whole = read_file(file);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    write_atomically(file, whole.substr(0, length));
    EXPECT_EQ(read_state(file, "key"), std::nullopt) << length;
  }
  write_atomically(file, whole + "x");
  EXPECT_EQ(read_state(file, "key"), std::nullopt);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string wrong = whole;
    wrong[i] = static_cast<char>(wrong[i] ^ 1);
    write_atomically(file, wrong);
    EXPECT_EQ(read_state(file, "key"), std::nullopt) << i;
  }
  write_atomically(file, whole);
  EXPECT_EQ(read_state(file, "key"), bytes(200));
}

TEST(SavedState, ChecksumsOfFilesAreThoseOfTheirContent) {
  const ScratchFolder folder;
  for (const std::size_t size : {0U, 5U, 4096U, 3'000'001U}) {
    const auto file = folder.write("file", bytes(size));
    EXPECT_EQ(file_checksum(file), checksum(bytes(size))) << size;
  }
  EXPECT_NE(checksum("ab"), checksum("ba"));
  EXPECT_NE(checksum(std::string(1, '\0')), checksum(std::string(2, '\0')));
  EXPECT_EQ(file_checksum(folder / "missing"), std::nullopt);
}

TEST(SavedState, IsReadWithItsKey) {
  const ScratchFolder folder;
  const auto file = folder / "part";
  write_state(file, "experiment a build b part c", bytes(50));
  const auto state = read_any_state(file);
  ASSERT_TRUE(state.has_value());
  EXPECT_EQ(state->key, "experiment a build b part c");
  EXPECT_EQ(state->content, bytes(50));
  write_atomically(file, read_file(file) + "x");
  EXPECT_FALSE(read_any_state(file).has_value());
}

}  // namespace
}  // namespace touchdown::experiments
