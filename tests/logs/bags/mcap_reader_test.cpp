#include "logs/bags/mcap_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/bag_writer.hpp"
#include "tests/logs/bags/read_bag.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::logs {
namespace {

using test::lines_of;
using test::mcap_bytes;
using test::ReadBag;
using test::TestBag;
using ::testing::HasSubstr;

TestBag made_up_bag(std::size_t messages = 45) { return test::two_topics(0, messages); }

class Mcap : public ::testing::Test {
 protected:
  ReadBag read(const std::string& bytes, const TopicFilter& wanted = {}) {
    const std::filesystem::path path = folder_ / "bag.mcap";
    std::ofstream(path, std::ios::binary) << bytes;
    return test::read_bag<McapReader>(path, wanted);
  }

  ScratchFolder folder_;
};

const std::vector<std::string> compressions = {"", "lz4", "zstd"};

TEST_F(Mcap, EveryLayoutHasTheSameMessages) {
  const TestBag bag = made_up_bag();
  for (const std::string& compression : compressions) {
    for (const std::size_t per_chunk : {0U, 1U, 10U, 1000U}) {
      for (const int flags : {0, 1, 2, 3, 4, 7}) {
        SCOPED_TRACE(fmt::format("'{}' {} {}", compression, per_chunk, flags));
        const ReadBag result = read(mcap_bytes(
            bag, {compression, per_chunk, (flags & 1) != 0, (flags & 2) != 0, (flags & 4) != 0}));
        EXPECT_EQ(result.messages, lines_of(bag));
        EXPECT_EQ(result.notes + result.error, "");
      }
    }
  }
}

TEST_F(Mcap, ABagWithoutMessagesIsEmpty) {
  const ReadBag result = read(mcap_bytes(made_up_bag(0)));
  EXPECT_TRUE(result.messages.empty());
  EXPECT_EQ(result.notes + result.error, "");
}

TEST_F(Mcap, MessagesComeInTheOrderOfTheFileAndWithinAChunkByTime) {
  TestBag bag = made_up_bag(40);
  std::reverse(bag.messages.begin(), bag.messages.end());
  bag.messages[33].time = bag.messages[32].time;
  for (const std::size_t per_chunk : {0U, 1U, 8U}) {
    TestBag sorted = bag;
    for (std::size_t k = 0; k < bag.messages.size(); k += std::max<std::size_t>(1, per_chunk)) {
      const auto chunk = sorted.messages.begin() + static_cast<std::ptrdiff_t>(k);
      std::stable_sort(chunk, chunk + static_cast<std::ptrdiff_t>(per_chunk),
                       [](const auto& x, const auto& y) { return x.time < y.time; });
    }
    EXPECT_EQ(read(mcap_bytes(bag, {"zstd", per_chunk})).messages, lines_of(sorted)) << per_chunk;
  }
}

TEST_F(Mcap, OnlyWantedTopicsAreRead) {
  const ReadBag result = read(mcap_bytes(made_up_bag()), [](auto topic) { return topic == "/b"; });
  EXPECT_EQ(result.messages.size(), 15U);
  for (const std::string& one : result.messages) EXPECT_THAT(one, HasSubstr("/b pkg/msg/B"));
}

/// Whatever the byte at which a file ends, its whole records are read, and the loss is reported.
TEST_F(Mcap, AFileThatIsCutOffIsReadAsFarAsItIsWhole) {
  const TestBag bag = made_up_bag(25);
  const std::vector<std::string> all = lines_of(bag);
  for (const std::string& compression : compressions) {
    for (const std::size_t per_chunk : {0U, 5U}) {
      const std::string bytes = mcap_bytes(bag, {compression, per_chunk});
      std::size_t before = 0;
      for (std::size_t size = 8; size < bytes.size(); ++size) {
        SCOPED_TRACE(fmt::format("'{}' {} {}", compression, per_chunk, size));
        const ReadBag result = read(bytes.substr(0, size));
        EXPECT_EQ(result.error, "");
        EXPECT_THAT(result.notes, HasSubstr(fmt::format("cut off at byte {}", size)));
        ASSERT_LE(result.messages.size(), all.size());
        EXPECT_TRUE(std::equal(result.messages.begin(), result.messages.end(), all.begin()));
        EXPECT_GE(result.messages.size(), before);  // more bytes, no fewer messages
        before = result.messages.size();
      }
      EXPECT_EQ(before, all.size());
    }
  }
}

TEST_F(Mcap, AnyChangedByteOfCheckedDataIsAnErrorOrHarmless) {
  const TestBag bag = made_up_bag(20);
  const std::vector<std::string> all = lines_of(bag);
  for (const std::string& compression : compressions) {
    const std::string bytes = mcap_bytes(bag, {compression, 5});
    std::size_t errors = 0;
    for (std::size_t at = 0; at < bytes.size(); ++at) {
      std::string changed = bytes;
      changed[at] = static_cast<char>(changed[at] ^ 0x15);
      const ReadBag result = read(changed);
      if (!result.error.empty()) {
        ++errors;
        EXPECT_THAT(result.error, HasSubstr("bag.mcap"));
      } else if (result.messages != all) {
        EXPECT_NE(result.notes, "") << at;  // taken for a file that is cut off
      }
    }
    EXPECT_GT(errors, bytes.size() / 2);
  }
}

TEST_F(Mcap, MalformedFilesAreRefusedWithTheirByte) {
  const TestBag bag = made_up_bag(20);
  const std::string good = mcap_bytes(bag, {"", 5});
  const std::string head = good.substr(0, 8);
  const auto u64 = [](std::uint64_t value) {
    return std::string(reinterpret_cast<const char*>(&value), 8);  // NOLINT
  };
  const std::string none(4, '\0');
  EXPECT_THAT(read("").error, HasSubstr("no MCAP file"));
  EXPECT_THAT(read("#ROSBAG V2.0\n").error, HasSubstr("no MCAP file"));
  // A message of a channel that is not defined.
  const std::string message =
      test::mcap_record(5, std::string("\7\0", 2) + none + u64(1) + u64(1) + "data");
  EXPECT_THAT(read(head + message).error, HasSubstr("channel 7, which is not defined"));
  // Sizes far beyond the chunk: more than the file, and more than the memory.
  for (const std::uint64_t size : {std::uint64_t{1} << 40U, ~std::uint64_t{0}}) {
    const std::string chunk = test::mcap_record(
        6, fmt::format("{}{}{}{}{}{}abc", u64(1), u64(2), u64(size), none, none, u64(3)));
    EXPECT_THAT(read(head + chunk).error, HasSubstr("byte 8: chunk")) << size;
    const std::string records = test::mcap_record(
        6, fmt::format("{}{}{}{}{}{}abc", u64(1), u64(2), u64(3), none, none, u64(size)));
    EXPECT_THAT(read(head + records).error, HasSubstr("byte 8: chunk")) << size;
    const std::string beyond = fmt::format("{}\6{}abc", head, u64(size));
    EXPECT_THAT(read(beyond).notes, HasSubstr("cut off"));
  }
  const std::string compression = test::mcap_record(
      6, u64(1) + u64(2) + u64(3) + none + std::string("\3\0\0\0bz2", 7) + u64(3) + "abc");
  EXPECT_THAT(read(head + compression).error, HasSubstr("expected none, lz4 or zstd"));
  EXPECT_THAT(read(head + test::mcap_record(6, "short")).error, HasSubstr("ends beyond"));
  EXPECT_THAT(read(head + test::mcap_record(3, "")).error, HasSubstr("ends beyond"));
}

/// Sixty bytes must not become gigabytes.
TEST_F(Mcap, AChunkThatHoldsMoreThanItDeclaresIsRefused) {
  const std::string zeros(std::size_t{1} << 22U, '\0');
  const auto u64 = [](std::uint64_t value) {
    return std::string(reinterpret_cast<const char*>(&value), 8);  // NOLINT
  };
  for (const std::string name : {"lz4", "zstd"}) {
    const std::string stored =
        name == "lz4" ? test::lz4_compressed(zeros) : test::zstd_compressed(zeros);
    const std::string chunk =
        test::mcap_record(6, fmt::format("{}{}{}{}{}{}{}{}{}", u64(1), u64(2), u64(100),
                                         std::string(4, '\0'), static_cast<char>(name.size()),
                                         std::string(3, '\0'), name, u64(stored.size()), stored));
    EXPECT_THAT(read(std::string("\x89MCAP0\r\n", 8) + chunk).error,
                HasSubstr("more bytes than it declares"));
  }
}

}  // namespace
}  // namespace touchdown::logs
