#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "logs/bags/message.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace touchdown::logs {

/// Reads the messages of a SQLite bag (`.db3`) in the order of the file. A damaged file is read as
/// far as its pages are whole; `note()` describes it. Errors (`InputError`): a file that is no
/// SQLite database, or one without a bag's tables; one whose pages name each other again and again,
/// so that it has more rows than its bytes can hold.
class SqliteReader {
 public:
  /// A topic is read if `wanted` is empty or true for it. `name` is the file's in messages. Reading
  /// ends with `Stopped` once `stop` is true; it may be null.
  explicit SqliteReader(const std::filesystem::path& path, const TopicFilter& wanted = {},
                        const std::string& name = {}, const std::atomic<bool>* stop = nullptr);

  /// Proceeds to the next message. Returns false at the end.
  bool next(BagMessage& message);

  const std::vector<BagTopic>& topics() const { return topics_; }
  /// What could not be read, or empty.
  const std::string& note() const { return note_; }

 private:
  struct Close {
    void operator()(sqlite3* database) const;
    void operator()(sqlite3_stmt* statement) const;
  };
  using Statement = std::unique_ptr<sqlite3_stmt, Close>;

  int try_open(const std::string& uri, bool salvages);
  void open(const std::filesystem::path& path);
  bool has_table(std::string_view name);
  void read_topics(const TopicFilter& wanted);
  void read_definitions();
  Statement prepare(const std::string& sql);
  bool step(sqlite3_stmt* statement);
  void take(BagMessage& message);
  [[noreturn]] void complain_unreadable() const;
  [[noreturn]] void complain(const std::string& what) const;

  std::string name_;
  const std::atomic<bool>* stop_;
  std::uint64_t steps_left_ = 0;  ///< of SQLite's virtual machine, in hundreds
  bool is_copy_ = false;          ///< of the whole pages of a file that is cut off
  std::unique_ptr<sqlite3, Close> database_;
  std::vector<BagTopic> topics_;
  std::map<std::int64_t, std::size_t> index_of_id_;  ///< of the wanted topics
  Statement rows_;                                   ///< messages; null at the end
  std::string note_;
  std::uint64_t messages_ = 0;
};

}  // namespace touchdown::logs
