#include "logs/bags/sqlite_reader.hpp"

#include <algorithm>
#include <sqlite3.h>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/stop.hpp"
#include "logs/bags/files.hpp"

namespace touchdown::logs {

namespace {

/// Largest message; SQLite refuses longer values without memory for them.
constexpr int most_message_bytes = 1 << 28;

/// SQLite's virtual machine needs at most 40 steps to order and read a message, which takes 12
/// bytes and more in the file, and a few thousand to open it.
constexpr std::uint64_t steps_per_byte = 8;
constexpr std::uint64_t steps_at_start = 1'000'000;
constexpr int steps_at_once = 100;

/// The path as a URI of SQLite, in which these characters have a meaning.
std::string uri_of(const std::string& path, const char* options) {
  std::string uri = "file:";
  for (const char c : path) {
    if (c == '%' || c == '?' || c == '#') {
      uri += fmt::format("%{:02x}", static_cast<unsigned char>(c));
    } else {
      uri += c;
    }
  }
  return uri + options;
}

std::string text_at(sqlite3_stmt* row, int column) {
  const unsigned char* text = sqlite3_column_text(row, column);
  return text == nullptr ? "" : reinterpret_cast<const char*>(text);  // NOLINT
}

/// The size of a file's pages, from its head: big-endian; 1 is 65536.
std::uint64_t page_bytes(const RandomFile& file) {
  std::string head;
  file.read(16, 2, head);
  const auto byte = [&](std::size_t i) {
    return i < head.size() ? static_cast<std::uint64_t>(static_cast<unsigned char>(head[i])) : 0U;
  };
  const std::uint64_t given = 256 * byte(0) + byte(1);
  return given == 1 ? 65536 : std::max<std::uint64_t>(given, 512);
}

/// SQLite would take the missing bytes of the last page for zeros, and those for messages.
void copy_whole_pages(const std::filesystem::path& path, const RandomFile& file,
                      const std::filesystem::path& copy) {
  const std::uint64_t page = page_bytes(file);
  std::error_code wrong;
  std::filesystem::copy_file(path, copy, wrong);
  if (!wrong) std::filesystem::resize_file(copy, file.size() / page * page, wrong);
  if (wrong) {
    throw Error(
        fmt::format("{}: cannot be copied to {}: {}", file.name(), copy.string(), wrong.message()));
  }
}

}  // namespace

void SqliteReader::Close::operator()(sqlite3* database) const { sqlite3_close(database); }
void SqliteReader::Close::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

SqliteReader::SqliteReader(const std::filesystem::path& path, const TopicFilter& wanted,
                           const std::string& name, const std::atomic<bool>* stop)
    : name_(name.empty() ? path.string() : name), stop_(stop) {
  open(path);
  for (const char* table : {"topics", "messages"}) {
    if (!has_table(table)) complain(fmt::format("is no ROS 2 bag: it has no table '{}'", table));
  }
  read_topics(wanted);
  std::vector<std::int64_t> ids;
  for (const auto& [id, index] : index_of_id_) ids.push_back(id);
  const std::string where = fmt::format("WHERE topic_id IN ({})", fmt::join(ids, ","));
  // An index may be damaged, and its order jumps between pages.
  rows_ = prepare("SELECT topic_id, timestamp, data FROM messages NOT INDEXED " + where);
}

/// Opens the database to read it; returns SQLite's code. `salvages` accepts a file that is shorter
/// than it declares.
int SqliteReader::try_open(const std::string& uri, bool salvages) {
  sqlite3* opened = nullptr;
  const int result =
      sqlite3_open_v2(uri.c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  database_.reset(opened);
  if (opened == nullptr) throw Error("SQLite: no memory");
  if (result != SQLITE_OK) return result;
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, most_message_bytes);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_WRITABLE_SCHEMA, salvages ? 1 : 0, nullptr);
  sqlite3_progress_handler(
      opened, steps_at_once,
      [](void* self) {
        auto& reader = *static_cast<SqliteReader*>(self);
        const bool is_stopped = reader.stop_ != nullptr && *reader.stop_;
        return is_stopped || reader.steps_left_ == 0 || --reader.steps_left_ == 0 ? 1 : 0;
      },
      this);
  sqlite3_exec(opened, "PRAGMA cell_size_check = ON", nullptr, nullptr, nullptr);
  return sqlite3_exec(opened, "SELECT name FROM sqlite_master LIMIT 1", nullptr, nullptr, nullptr);
}

/// Only a journal (`-wal`) beside the database is a reason to write beside it: SQLite then needs a
/// file of its own. In a folder that cannot be written the database is read without its journal.
void SqliteReader::open(const std::filesystem::path& path) {
  const RandomFile file(path, name_);
  steps_left_ = (steps_per_byte * file.size() + steps_at_start) / steps_at_once;
  std::error_code none;
  const std::uintmax_t journal = std::filesystem::file_size(path.string() + "-wal", none);
  int result = SQLITE_CANTOPEN;
  if (!none && journal > 0) result = try_open(uri_of(path, "?mode=ro"), false);
  if (result == SQLITE_CANTOPEN || result == SQLITE_READONLY) {
    result = try_open(uri_of(path, "?mode=ro&immutable=1"), false);
  }
  const bool is_cut = file.size() % page_bytes(file) != 0;
  if (result == SQLITE_CORRUPT || (result == SQLITE_OK && is_cut)) {
    const PartFolder folder(temporary_folder() / "touchdown_bag");
    const std::filesystem::path copy = folder.path() / "copy";
    copy_whole_pages(path, file, copy);
    is_copy_ = true;
    result = try_open(uri_of(copy, "?mode=ro"), true);
  }
  if (result == SQLITE_NOTADB) complain("is no SQLite database: is it compressed?");
  if (result != SQLITE_OK) complain_unreadable();
  for (const char* suffix : {"-wal", "-journal"}) {
    const std::uintmax_t bytes = std::filesystem::file_size(path.string() + suffix, none);
    if (none || bytes == 0) continue;
    note_ = fmt::format(
        "{0}: {0}{1} is beside it: it is being recorded, or its recorder was killed; "
        "its last messages may be missing",
        name_, suffix);
  }
}

/// Whether it has this table. A view or a virtual table of the name, which could run code or never
/// end, is none.
bool SqliteReader::has_table(std::string_view name) {
  const Statement found =
      prepare(fmt::format("SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = '{}' "
                          "AND sql NOT LIKE 'CREATE VIRTUAL%'",
                          name));
  return step(found.get());
}

void SqliteReader::read_topics(const TopicFilter& wanted) {
  const Statement rows = prepare("SELECT id, name, type, serialization_format FROM topics");
  while (step(rows.get())) {
    const std::int64_t id = sqlite3_column_int64(rows.get(), 0);
    BagTopic topic{text_at(rows.get(), 1), text_at(rows.get(), 2), text_at(rows.get(), 3)};
    if (!wanted || wanted(topic.name)) index_of_id_[id] = topics_.size();
    topics_.push_back(std::move(topic));
  }
  try {
    read_definitions();
  } catch (const InputError&) {  // NOLINT(bugprone-empty-catch): a part that is cut off
  }
}

/// The definitions of types, of newer bags.
void SqliteReader::read_definitions() {
  if (!has_table("message_definitions")) return;
  const Statement types = prepare("SELECT * FROM message_definitions");
  const auto column = [&](std::string_view name) {
    int i = sqlite3_column_count(types.get());
    while (--i >= 0 && name != sqlite3_column_name(types.get(), i)) {
    }
    return i;  // of −1, SQLite gives null
  };
  while (step(types.get())) {
    if (text_at(types.get(), column("encoding")) != "ros2msg") continue;
    for (BagTopic& topic : topics_) {
      if (topic.type != text_at(types.get(), column("topic_type"))) continue;
      topic.definition = text_at(types.get(), column("encoded_message_definition"));
    }
  }
}

SqliteReader::Statement SqliteReader::prepare(const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &statement, nullptr) != SQLITE_OK) {
    if (sqlite3_errcode(database_.get()) == SQLITE_INTERRUPT) complain_unreadable();
    complain(fmt::format("is no ROS 2 bag: {}", sqlite3_errmsg(database_.get())));
  }
  return Statement(statement);
}

/// Returns false behind the last row. Errors: `InputError` for a damaged database.
bool SqliteReader::step(sqlite3_stmt* statement) {
  const int result = sqlite3_step(statement);
  if (result == SQLITE_ROW) return true;
  if (result == SQLITE_DONE) return false;
  complain_unreadable();
}

bool SqliteReader::next(BagMessage& message) {
  if (!rows_) return false;
  try {
    if (step(rows_.get())) {
      take(message);
      return true;
    }
    if (is_copy_) note_ = fmt::format("{}: cut off: {} messages were read", name_, messages_);
  } catch (const InputError&) {
    if (messages_ == 0) throw;
    note_ = fmt::format("{}: damaged or cut off: {} messages were read, others are lost", name_,
                        messages_);
  }
  rows_.reset();
  return false;
}

void SqliteReader::take(BagMessage& message) {
  message.topic = index_of_id_.at(sqlite3_column_int64(rows_.get(), 0));
  message.time = sqlite3_column_int64(rows_.get(), 1);
  const void* data = sqlite3_column_blob(rows_.get(), 2);
  const int size = sqlite3_column_bytes(rows_.get(), 2);
  message.data = data == nullptr ? std::string_view()
                                 : std::string_view(static_cast<const char*>(data),
                                                    static_cast<std::size_t>(size));
  ++messages_;
}

void SqliteReader::complain_unreadable() const {
  end_if(stop_);
  complain(steps_left_ > 0 ? fmt::format("cannot be read: {}", sqlite3_errmsg(database_.get()))
                           : "its pages name each other again and again: it is damaged");
}

void SqliteReader::complain(const std::string& what) const {
  throw InputError(fmt::format("{}: {}", name_, what));
}

}  // namespace touchdown::logs
