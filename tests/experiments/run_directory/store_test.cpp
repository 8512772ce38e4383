#include "experiments/run_directory/store.hpp"

#include <map>
#include <tuple>

#include <gmock/gmock.h>
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

/// A part with everything that can be saved.
struct Part {
  struct Item {
    std::string name;
    double number = 0.0;
    static auto members(auto& item) { return std::tie(item.name, item.number); }
    friend bool operator==(const Item&, const Item&) = default;
  };
  std::vector<Item> items;
  std::vector<std::int64_t> numbers;
  std::map<std::string, std::vector<Item>> by_name;
  static auto members(auto& part) { return std::tie(part.items, part.numbers, part.by_name); }
  friend bool operator==(const Part&, const Part&) = default;
};

TEST(Store, ReturnsAPartToItsOwnExperimentBuildKindAndNameOnly) {
  const ScratchFolder folder;
  const Store files(folder.path(), "experiment a build b");
  for (const Store& store : {files, Store()}) {
    EXPECT_EQ(store.read("kind", "part"), std::nullopt);
    for (const std::size_t size : {0U, 1U, 31U, 32U, 1000U}) {
      store.write("kind", "part", bytes(size));
      EXPECT_EQ(store.read("kind", "part"), bytes(size));
      EXPECT_EQ(store.read("kind", "other"), std::nullopt);
      EXPECT_EQ(store.read("other", "part"), std::nullopt);
    }
  }
  EXPECT_EQ(Store(folder.path(), "experiment a build c").read("kind", "part"), std::nullopt);
  EXPECT_EQ(Store(folder.path(), "").read("kind", "part"), std::nullopt);
  EXPECT_EQ(files.read("kind", ""), std::nullopt);  // a folder
  EXPECT_THAT(files.names("kind"), ::testing::ElementsAre("part"));
  EXPECT_THAT(files.names("other"), ::testing::IsEmpty());
}

TEST(Store, ComputesWhatIsMissingOnceAndReturnsItUnchanged) {
  const ScratchFolder folder;
  Part part = {{{"a", 0.1}, {"", -1.0}}, {1, -2, 3}, {{"x y", {{"b\n", 2.0}}}, {"", {}}}};
  int computed = 0;
  for (int pass = 0; pass < 3; ++pass) {
    const Store store(folder.path(), "key");
    EXPECT_EQ(store.get<Part>("kind", "part",
                              [&] {
                                ++computed;
                                return part;
                              }),
              part);
    EXPECT_EQ(store.find<Part>("kind", "part"), part);
  }
  EXPECT_EQ(computed, 1);
  const std::string all = pack(part);
  for (std::size_t size = 0; size < all.size(); ++size) {
    std::string_view beginning = std::string_view(all).substr(0, size);
    EXPECT_THROW((void)unpack<Part>(beginning), Error) << size;
  }
}

TEST(Store, TakesADamagedFileForMissing) {
  const ScratchFolder folder;
  const Store store(folder.path(), "key");
  store.write("kind", "part", bytes(200));
  const auto file = folder / "state/kind/part";
  const std::string whole = read_file(file);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    write_atomically(file, whole.substr(0, length));
    EXPECT_EQ(store.read("kind", "part"), std::nullopt) << length;
  }
  write_atomically(file, whole + "x");
  EXPECT_EQ(store.read("kind", "part"), std::nullopt);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string wrong = whole;
    wrong[i] = static_cast<char>(wrong[i] ^ 1);
    write_atomically(file, wrong);
    EXPECT_EQ(store.read("kind", "part"), std::nullopt) << i;
  }
  write_atomically(file, whole);
  EXPECT_EQ(store.read("kind", "part"), bytes(200));
}

TEST(Checksum, OfAFileIsThatOfItsContent) {
  const ScratchFolder folder;
  for (const std::size_t size : {0U, 5U, 4096U, 3'000'001U}) {
    const auto file = folder.write("file", bytes(size));
    EXPECT_EQ(file_checksum(file), checksum(bytes(size))) << size;
  }
  EXPECT_NE(checksum("ab"), checksum("ba"));
  EXPECT_NE(checksum(std::string(1, '\0')), checksum(std::string(2, '\0')));
  EXPECT_EQ(file_checksum(folder / "missing"), std::nullopt);
}

}  // namespace
}  // namespace touchdown::experiments
