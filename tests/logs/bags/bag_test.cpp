#include "logs/bags/bag.hpp"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sqlite3.h>
#include <string>
#include <sys/stat.h>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "logs/bags/topic_rows.hpp"
#include "tests/bag_writer.hpp"
#include "tests/complaint.hpp"
#include "tests/logs/bags/read_bag.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::logs {
namespace {

namespace fs = std::filesystem;
using test::lines_of;
using test::ReadBag;
using test::TestBag;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

TestBag two_topics(std::size_t begin = 0, std::size_t end = 40) {
  return test::two_topics(begin, end, 20);
}

ReadBag read_bag(const fs::path& path, const TopicFilter& wanted = {}) {
  return test::read_bag<BagReader>(path, wanted);
}

class Bag : public ::testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& bytes) const {
    fs::path path = folder_ / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  fs::path write_db3(const std::string& name, const TestBag& bag, bool zstd = false,
                     bool has_index = true) const {
    fs::path path = folder_ / name;
    fs::create_directories(path.parent_path());
    test::write_db3(bag, path, zstd, has_index);
    return path;
  }

  ScratchFolder folder_;
};

TEST_F(Bag, SqliteBagsOfAnyKindHaveTheSameMessages) {
  const TestBag bag = two_topics();
  int n = 0;
  for (const bool zstd : {false, true}) {
    for (const bool has_index : {false, true}) {
      const fs::path path = write_db3(fmt::format("bag {}%20#?.db3", n++), bag, zstd, has_index);
      const ReadBag result = read_bag(path);
      EXPECT_EQ(result.error, "");
      EXPECT_EQ(result.messages, lines_of(bag));
      EXPECT_TRUE(result.notes.empty());
      const fs::path whole =
          write(path.filename().string() + ".zstd", test::zstd_compressed(read_file(path)));
      EXPECT_EQ(read_bag(whole).messages, lines_of(bag));
      EXPECT_EQ(read_bag(path, [](auto topic) { return topic == "/b"; }).messages.size(), 14U);
    }
  }
}

/// The reader decompresses in steps of 128 KiB, and a frame may end where a step does.
TEST_F(Bag, CompressedSqliteBagsOfAnySizeAreWhole) {
  const TestBag bag = two_topics();
  const fs::path path = write_db3("bag.db3", bag);
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  sqlite3_exec(database, "PRAGMA page_size = 65536; VACUUM", nullptr, nullptr, nullptr);
  for (int i = 0; i < 4; ++i) {
    const std::string text = fmt::format("CREATE TABLE more_{} (x)", i);
    ASSERT_EQ(sqlite3_exec(database, text.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    const std::string bytes = read_file(path);
    ASSERT_EQ(bytes.size() % 65536, 0U);
    const fs::path whole = write("whole.db3.zstd", test::zstd_compressed(bytes));
    EXPECT_EQ(read_bag(whole).messages, lines_of(bag)) << bytes.size();
    const std::size_t part = std::size_t{1} << 17U;
    const fs::path frames = write("frames.db3.zstd", test::zstd_compressed(bytes.substr(0, part)) +
                                                         test::zstd_compressed(bytes.substr(part)));
    EXPECT_EQ(read_bag(frames).messages, lines_of(bag)) << bytes.size();
    const std::string cut = read_file(whole).substr(0, fs::file_size(whole) - 1);
    EXPECT_THAT(read_bag(write("cut.db3.zstd", cut)).error, HasSubstr("end early"));
  }
  sqlite3_close(database);
}

/// rosbag2 writes databases with a journal, which SQLite would open beside the bag.
TEST_F(Bag, ASqliteBagIsReadWithoutAFileBesideIt) {
  const TestBag bag = two_topics();
  const fs::path path = write_db3("bag/bag.db3", bag);
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  const int changed =
      sqlite3_exec(database, "PRAGMA journal_mode = WAL", nullptr, nullptr, nullptr);
  EXPECT_EQ(changed, SQLITE_OK);
  sqlite3_close(database);
  EXPECT_EQ(read_bag(path).messages, lines_of(bag));
  const auto files = fs::directory_iterator(path.parent_path());
  EXPECT_EQ(std::distance(fs::begin(files), fs::end(files)), 1);
}

TEST_F(Bag, FilesOfAFolderAreReadInTheirOrder) {
  const std::vector<std::string> all = lines_of(two_topics());
  const std::string listed =
      "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: mcap\n"
      "  relative_file_paths:\n";
  // Without metadata, by number: 9 before 10. With it, as listed. Both kinds of names are met.
  for (const char* metadata :
       {"", "run_9.mcap run_10.mcap", "run/run_9.mcap run/run_10.mcap", "{{{"}) {
    for (const bool is_compressed : {false, true}) {
      const std::string name =
          fmt::format("{}{}", fs::path(metadata).filename().string(), is_compressed);
      const fs::path folder =
          folder_ / ("f" + std::to_string(std::hash<std::string>()(metadata + name)));
      const auto put = [&](const std::string& file, const std::string& bytes) {
        fs::create_directories(folder);
        std::ofstream(folder / (file + (is_compressed ? ".zstd" : "")), std::ios::binary)
            << (is_compressed ? test::zstd_compressed(bytes) : bytes);
      };
      put("run_9.mcap", test::mcap_bytes(two_topics(0, 15)));
      put("run_10.mcap", test::mcap_bytes(two_topics(15, 40), {"zstd"}));
      const std::string files = metadata;
      if (files == "{{{") {
        std::ofstream(folder / "metadata.yaml") << files;
      } else if (!files.empty()) {
        const std::size_t space = files.find(' ');
        std::ofstream(folder / "metadata.yaml") << listed << "    - " << files.substr(0, space)
                                                << "\n    - " << files.substr(space + 1) << "\n";
      }
      SCOPED_TRACE(files);
      const ReadBag result = read_bag(folder);
      EXPECT_EQ(result.error, "");
      EXPECT_EQ(result.messages, all);
      EXPECT_TRUE(is_bag(folder));
    }
  }
}

TEST_F(Bag, AFileThatMetadataListsMustBeThere) {
  write("bag/metadata.yaml",
        "rosbag2_bagfile_information: {relative_file_paths: [a_0.mcap, a_1.mcap]}\n");
  write("bag/a_0.mcap", test::mcap_bytes(two_topics()));
  EXPECT_THAT(read_bag(folder_ / "bag").error,
              AllOf(HasSubstr("metadata.yaml"), HasSubstr("a_1.mcap")));
}

TEST_F(Bag, OtherFilesAreRefusedWithARemedy) {
  EXPECT_THAT(read_bag(write("old.bag", "#ROSBAG V2.0\nmore")).error,
              AllOf(HasSubstr("ROS 1"), HasSubstr("rosbags-convert")));
  EXPECT_THAT(read_bag(write("renamed.mcap", "#ROSBAG V2.0\nmore")).error,
              HasSubstr("rosbags-convert"));
  EXPECT_THAT(read_bag(write("empty.db3", "")).error, HasSubstr("empty"));
  EXPECT_THAT(read_bag(write("text.mcap", "some text")).error, HasSubstr("no ROS 2 bag"));
  EXPECT_THAT(read_bag(write("header.db3", "SQLite format 3\n")).error, HasSubstr("header.db3"));
  EXPECT_THAT(read_bag(folder_ / "none.mcap").error, HasSubstr("no such file"));
  fs::create_directories(folder_ / "folder");
  EXPECT_THAT(read_bag(folder_ / "folder").error, HasSubstr("expected a ROS 2 bag"));
  const std::string whole = test::zstd_compressed(test::mcap_bytes(two_topics()));
  EXPECT_THAT(read_bag(write("cut.mcap.zstd", whole.substr(0, whole.size() / 2))).error,
              HasSubstr("cut.mcap.zstd"));
}

/// A database without a bag's tables, or with something else of their names.
TEST_F(Bag, OtherDatabasesAreRefused) {
  const auto with = [&](const std::string& name, const std::string& sql) {
    fs::path path = folder_ / name;
    test::run_sql(path, sql);
    return read_bag(path).error;
  };
  EXPECT_THAT(with("a.db3", "CREATE TABLE other(x)"), HasSubstr("no table 'topics'"));
  EXPECT_THAT(with("b.db3", "CREATE TABLE topics(id, name, type, serialization_format)"),
              HasSubstr("no table 'messages'"));
  EXPECT_THAT(with("c.db3", "CREATE TABLE topics(x); CREATE TABLE messages(y)"),
              HasSubstr("is no ROS 2 bag"));
  EXPECT_THAT(
      with(
          "d.db3",
          "CREATE TABLE topics(id, name, type, serialization_format); CREATE VIEW messages AS WITH "
          "RECURSIVE n(topic_id, timestamp, data) AS (SELECT 1, 1, 1 UNION ALL SELECT 1, 1, 1 FROM "
          "n) SELECT * FROM n"),
      HasSubstr("no table 'messages'"));
}

/// Interior pages of a table that each name the next one in all of their cells, so that a few
/// kilobytes have more rows than anybody could read.
std::string chained(std::string bytes, std::size_t root) {
  const std::size_t page =
      256 * static_cast<unsigned char>(bytes[16]) + static_cast<unsigned char>(bytes[17]);
  std::vector<std::size_t> interior = {root};
  for (std::size_t number = 2; number <= bytes.size() / page; ++number) {
    if (number != root && bytes[(number - 1) * page] == 5) interior.push_back(number);
  }
  interior.resize(std::min<std::size_t>(interior.size(), 12));
  const auto number_at = [&](std::size_t at) {
    return 256 * static_cast<std::size_t>(static_cast<unsigned char>(bytes[at])) +
           static_cast<unsigned char>(bytes[at + 1]);
  };
  for (std::size_t i = 0; i + 1 < interior.size(); ++i) {
    const std::size_t begin = (interior[i] - 1) * page;
    const auto point = [&](std::size_t at) {
      bytes[at] = bytes[at + 1] = 0;
      bytes[at + 2] = static_cast<char>(interior[i + 1] / 256);
      bytes[at + 3] = static_cast<char>(interior[i + 1] % 256);
    };
    point(begin + 8);  // the rightmost child
    for (std::size_t cell = 0; cell < number_at(begin + 3); ++cell) {
      point(begin + number_at(begin + 12 + 2 * cell));
    }
  }
  return bytes;
}

TEST_F(Bag, ADatabaseWithMoreRowsThanItsBytesCanHoldEnds) {
  for (const bool has_index : {false, true}) {
    const fs::path path = folder_ / fmt::format("small_{}.db3", has_index);
    test::run_sql(path, "PRAGMA page_size = 512; CREATE TABLE dummy(x)");
    test::write_db3(two_topics(0, 4000), path, false, has_index);
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
    for (const char* table : {"messages", "topics"}) {
      sqlite3_stmt* row = nullptr;
      const std::string sql =
          fmt::format("SELECT rootpage FROM sqlite_master WHERE name = '{}'", table);
      ASSERT_EQ(sqlite3_prepare_v2(database, sql.c_str(), -1, &row, nullptr), SQLITE_OK);
      ASSERT_EQ(sqlite3_step(row), SQLITE_ROW);
      const auto root = static_cast<std::size_t>(sqlite3_column_int64(row, 0));
      sqlite3_finalize(row);
      const std::string bytes = chained(read_file(path), root);
      const ReadBag result = read_bag(write("endless.db3", bytes));
      EXPECT_LT(result.messages.size(), 2 * bytes.size()) << table;
      EXPECT_THAT(result.error + result.notes,
                  AnyOf(HasSubstr("again and again"), HasSubstr("damaged"), HasSubstr("malformed")))
          << table;
    }
    sqlite3_close(database);
  }
}

TEST_F(Bag, AReaderOfAnyKindEndsWhenAsked) {
  const TestBag bag = two_topics();
  const std::string mcap = test::mcap_bytes(bag);
  const std::atomic<bool> stop = true;
  for (const fs::path& path :
       {write("a.mcap", mcap), write("b.mcap.zstd", test::zstd_compressed(mcap)),
        write_db3("c.db3", two_topics(0, 4000)),
        write("d.db3.zstd", test::zstd_compressed(read_file(write_db3("e.db3", bag))))}) {
    BagReader reader(path, {}, &stop);
    BagMessage message;
    EXPECT_THROW(while (reader.next(message)), Stopped) << path;
  }
}

TEST_F(Bag, AKilledReaderOfAnyKindLeavesNoTemporaryFile) {
  const TestBag bag = two_topics();
  const std::string database = read_file(write_db3("whole.db3", bag));
  const fs::path temporary = folder_ / "temporary";
  fs::create_directory(temporary);
  const TemporaryFilesIn there(temporary);
  for (const fs::path& path :
       {write("a.mcap.zstd", test::zstd_compressed(test::mcap_bytes(bag))),
        write("b.db3.zstd", test::zstd_compressed(database)),
        write("cut.db3", database.substr(0, database.size() - 100)),
        write("cut.db3.zstd", test::zstd_compressed(database.substr(0, database.size() - 100)))}) {
    BagReader reader(path);
    BagMessage message;
    for (int n = 0; reader.next(message); ++n) {
      EXPECT_TRUE(fs::is_empty(temporary)) << path << " message " << n;
    }
  }
}

TEST_F(Bag, ADatabaseThatIsBeingRecordedIsNamed) {
  const fs::path path = write_db3("bag.db3", two_topics());
  EXPECT_EQ(read_bag(path).notes, "");
  for (const char* suffix : {"-journal", "-wal"}) {
    const fs::path beside = write(std::string("bag.db3") + suffix, "unfinished");
    const ReadBag result = read_bag(path);
    EXPECT_EQ(result.messages, lines_of(two_topics())) << result.error;
    EXPECT_THAT(result.notes, HasSubstr(std::string("bag.db3") + suffix + " is beside it"));
    fs::remove(beside);
  }
}

TEST_F(Bag, MetadataThatIsNoFileIsNotWaitedFor) {
  const TestBag bag = two_topics();
  write("pipe/bag_0.mcap", test::mcap_bytes(bag));
  write("folder/bag_0.mcap", test::mcap_bytes(bag));
  ASSERT_EQ(::mkfifo((folder_ / "pipe/metadata.yaml").c_str(), 0600), 0);
  fs::create_directories(folder_ / "folder/metadata.yaml");
  for (const char* name : {"pipe", "folder"}) {
    EXPECT_EQ(read_bag(folder_ / name).messages, lines_of(bag)) << name;
  }
}

TEST_F(Bag, ASqliteBagThatIsCutOffIsReadAsFarAsItIsWhole) {
  const TestBag bag = two_topics(0, 2000);
  const std::vector<std::string> all = lines_of(bag);
  const std::set<std::string> known(all.begin(), all.end());
  for (const bool has_index : {false, true}) {
    const std::string bytes =
        read_file(write_db3(fmt::format("w{}.db3", has_index), bag, false, has_index));
    std::size_t most = 0;
    for (std::size_t size = 100; size < bytes.size(); size += 1511) {
      const ReadBag result = read_bag(write("cut.db3", bytes.substr(0, size)));
      if (!result.error.empty()) {
        EXPECT_THAT(result.error, HasSubstr("cut.db3"));
        continue;
      }
      EXPECT_NE(result.notes, "") << size;
      EXPECT_LE(result.messages.size(), all.size());
      for (const std::string& one : result.messages) {
        EXPECT_TRUE(known.contains(one));
      }
      most = std::max(most, result.messages.size());
    }
    EXPECT_GT(most, all.size() / 2);
  }
}

TEST_F(Bag, MissingAndOtherTopicsAreRefusedWithTheBagsTopics) {
  TestBag bag = two_topics();
  bag.topics.push_back({"/joint_states", joint_state_type});
  bag.messages.push_back({2, 5000, test::joint_state_cdr(0, {{"x"}, {1.0}, {}, {}})});
  bag.topics.push_back({"/silent", joint_state_type});
  const fs::path path = write("bag.mcap", test::mcap_bytes(bag));
  const auto complaint = [&](const std::string& topic) {
    return complaint_of([&] { (void)find_signal_topics(path, {topic}); });
  };
  EXPECT_EQ(complaint("/joint_states"), "no complaint");
  EXPECT_THAT(complaint("/silent"), AllOf(HasSubstr("has no message of topic /silent"),
                                          Not(HasSubstr("did you mean '/silent'"))));
  EXPECT_THAT(
      complaint("/joint_state"),
      AllOf(HasSubstr("did you mean '/joint_states'?"), HasSubstr("/a (pkg/msg/A, 26 messages)"),
            HasSubstr("/joint_states (sensor_msgs/msg/JointState, 1 messages)")));
  EXPECT_THAT(complaint("/b"), AllOf(HasSubstr("has the type 'pkg/msg/B'"),
                                     HasSubstr("/b (pkg/msg/B, 14 messages)")));
  EXPECT_EQ(only_topic_of_type(path, joint_state_type), "/joint_states");
  EXPECT_THAT(complaint_of([&] { (void)only_topic_of_type(path, imu_type); }),
              HasSubstr("has no topic of sensor_msgs/msg/Imu: name it in the mapping's `sources`"));
  bag.topics.push_back({"/imu", imu_type});
  const fs::path empty = folder_ / "empty.db3";
  test::write_db3(bag, empty);
  EXPECT_THAT(complaint_of([&] { (void)only_topic_of_type(empty, imu_type); }),
              AllOf(HasSubstr("has no message of sensor_msgs/msg/Imu: it has "),
                    HasSubstr("/imu (sensor_msgs/msg/Imu, 0 messages)")));
}

TEST_F(Bag, ATextWithABinaryZeroDoesNotEndTheMessageAboutIt) {
  TestBag bag = two_topics();
  bag.topics.push_back({std::string("/jo\0int", 7), "pkg/msg/B"});
  bag.messages.push_back({2, 5000, ""});
  const fs::path path = write("zero.mcap", test::mcap_bytes(bag));
  EXPECT_THAT(complaint_of([&] { (void)only_topic_of_type(path, imu_type); }),
              HasSubstr("/jo\u2400int (pkg/msg/B, 1 messages)"));
}

/// Bags that ROS 2 itself recorded.
TEST_F(Bag, RealBagsAreRead) {
  const fs::path bags = fs::path(TOUCHDOWN_REFERENCE_DATA) / "bags";
  if (!fs::exists(bags)) GTEST_SKIP() << "needs the bags of rosbag2's tests in " << bags;
  const auto counts = [&](const char* name) {
    const ReadBag result = read_bag(bags / name);
    EXPECT_EQ(result.error, "");
    EXPECT_TRUE(result.notes.empty());
    std::map<std::string, std::uint64_t> by_topic;
    for (const BagTopic& topic : result.topics) {
      if (topic.messages > 0) by_topic[topic.name + " " + topic.type] = topic.messages;
    }
    return by_topic;
  };
  EXPECT_EQ(counts("cdr_test.mcap"), counts("cdr_test.db3"));
  EXPECT_EQ(counts("talker.mcap"), counts("talker.db3"));
  EXPECT_FALSE(counts("talker.mcap").empty());
  EXPECT_EQ(read_bag(bags / "seek.mcap").messages.size(), 5U);
  EXPECT_GE(counts("topics_and_services.mcap").size(), 2U);
}

}  // namespace
}  // namespace touchdown::logs
