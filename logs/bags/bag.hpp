#pragma once

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "logs/bags/files.hpp"
#include "logs/bags/mcap_reader.hpp"
#include "logs/bags/message.hpp"
#include "logs/bags/sqlite_reader.hpp"

namespace touchdown::logs {

/// Whether a path is a ROS bag: a folder with `metadata.yaml`, `.mcap` or `.db3` files, or a file
/// with one of the extensions `.mcap`, `.db3`, `.mcap.zstd`, `.db3.zstd` and `.bag`, in any case.
bool is_bag(const std::filesystem::path& path);

/// Reads a ROS 2 bag: a folder with one file or several, or a bare file; MCAP or SQLite, plain or
/// compressed with zstd, by file or by message. A file that is compressed as a whole is
/// decompressed into a temporary file. Messages come by the time of recording, file by file.
/// Errors: `InputError` for a folder without files of a bag or with a file missing, for a ROS 1 bag
/// (it names the conversion), and as in `McapReader` and `SqliteReader`.
class BagReader {
 public:
  /// A topic is read if `wanted` is empty or true for it. `stop` may be null.
  explicit BagReader(const std::filesystem::path& path, TopicFilter wanted = {},
                     const std::atomic<bool>* stop = nullptr);

  /// Proceeds to the next message. Returns false at the end. Errors: also `Stopped` once `stop` is
  /// true.
  bool next(BagMessage& message);

  /// Topics found so far, with the number of messages read; complete at the end.
  const std::vector<BagTopic>& topics() const { return topics_.all(); }
  /// One line for each file that is cut off or damaged. Complete at the end.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  void open_next();
  bool read(BagMessage& message);

  TopicFilter wanted_;
  const std::atomic<bool>* stop_;
  std::vector<std::filesystem::path> files_;
  std::size_t next_file_ = 0;
  std::unique_ptr<McapReader> mcap_;
  std::unique_ptr<SqliteReader> sqlite_;
  std::vector<std::size_t> topic_of_;  ///< of each topic of the current file
  BagTopics topics_;
  std::string decompressed_;  ///< payload
  std::vector<std::string> notes_;
};

}  // namespace touchdown::logs
