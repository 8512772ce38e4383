#include "tests/bag_writer.hpp"

#include <bit>
#include <boost/crc.hpp>
#include <cstddef>
#include <lz4frame.h>
#include <sqlite3.h>
#include <stdexcept>
#include <zstd.h>

#include <fmt/format.h>

namespace touchdown::test {

namespace {

std::string little(std::uint64_t value, std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>((value >> (8 * i)) & 0xffU);
  return bytes;
}
std::string u16(std::uint64_t value) { return little(value, 2); }
std::string u32(std::uint64_t value) { return little(value, 4); }
std::string u64(std::uint64_t value) { return little(value, 8); }
std::string text(std::string_view value) { return u32(value.size()).append(value); }

std::uint32_t crc_of(std::string_view bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

std::string definitions(const TestBag& bag) {
  std::string bytes;
  for (std::size_t i = 0; i < bag.topics.size(); ++i) {
    const TestTopic& topic = bag.topics[i];
    bytes +=
        mcap_record(3, u16(i + 1) + text(topic.type) + text("ros2msg") + text(topic.definition));
    bytes += mcap_record(4, u16(i) + u16(i + 1) + text(topic.name) + text(topic.encoding) +
                                text(text("offered_qos_profiles") + text("")));
  }
  return bytes;
}

void run(sqlite3* database, const std::string& sql) {
  if (sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
    throw std::runtime_error(sqlite3_errmsg(database));
  }
}

}  // namespace

CdrBytes::CdrBytes(bool is_big_endian)
    : bytes_(is_big_endian ? std::string(4, '\0') : std::string("\0\1\0\0", 4)),
      is_big_(is_big_endian) {}

void CdrBytes::put(std::uint64_t bits, std::size_t size) {
  while ((bytes_.size() - 4) % size != 0) bytes_ += '\0';
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t byte = is_big_ ? size - 1 - i : i;
    bytes_ += static_cast<char>((bits >> (8 * byte)) & 0xffU);
  }
}
CdrBytes& CdrBytes::u8(std::uint8_t value) {
  put(value, 1);
  return *this;
}
CdrBytes& CdrBytes::f32(float value) {
  put(std::bit_cast<std::uint32_t>(value), 4);
  return *this;
}
CdrBytes& CdrBytes::u32(std::uint32_t value) {
  put(value, 4);
  return *this;
}
CdrBytes& CdrBytes::f64(double value) {
  put(std::bit_cast<std::uint64_t>(value), 8);
  return *this;
}
CdrBytes& CdrBytes::text(std::string_view value) {
  u32(static_cast<std::uint32_t>(value.size() + 1));
  bytes_.append(value);
  bytes_ += '\0';
  return *this;
}
CdrBytes& CdrBytes::f64s(const std::vector<double>& values) {
  u32(static_cast<std::uint32_t>(values.size()));
  for (const double value : values) f64(value);
  return *this;
}

std::string joint_state_cdr(std::int64_t stamp, const TestJoints& joints, bool is_big,
                            std::string_view frame) {
  CdrBytes cdr(is_big);
  cdr.u32(static_cast<std::uint32_t>(stamp / 1'000'000'000))
      .u32(static_cast<std::uint32_t>(stamp % 1'000'000'000))
      .text(frame);
  cdr.u32(static_cast<std::uint32_t>(joints.name.size()));
  for (const std::string& name : joints.name) cdr.text(name);
  return cdr.f64s(joints.position).f64s(joints.velocity).f64s(joints.effort).bytes();
}

std::string imu_cdr(std::int64_t stamp, const TestImu& imu, bool is_big, std::string_view frame) {
  CdrBytes cdr(is_big);
  cdr.u32(static_cast<std::uint32_t>(stamp / 1'000'000'000))
      .u32(static_cast<std::uint32_t>(stamp % 1'000'000'000))
      .text(frame);
  for (const double x : imu.orientation) cdr.f64(x);
  cdr.f64(imu.orientation_covariance);
  for (int i = 1; i < 9; ++i) cdr.f64(0.0);
  for (const double x : imu.angular_velocity) cdr.f64(x);
  for (int i = 0; i < 9; ++i) cdr.f64(0.0);
  for (const double x : imu.linear_acceleration) cdr.f64(x);
  for (int i = 0; i < 9; ++i) cdr.f64(0.0);
  return cdr.bytes();
}

std::string mcap_record(std::uint8_t op, std::string_view content) {
  return little(op, 1) + u64(content.size()) + std::string(content);
}

std::string mcap_bytes(const TestBag& bag, const McapOptions& options) {
  const std::string magic("\x89MCAP0\r\n", 8);
  const auto unknown = [&] {
    return options.has_unknown_records ? mcap_record(0x99, "a later version's record") : "";
  };
  std::string file = magic + mcap_record(1, text("ros2") + text("test") + "more") + unknown();
  std::string messages;
  std::uint64_t start = ~std::uint64_t{0};
  std::uint64_t end = 0;
  std::size_t in_chunk = 0;
  const auto finish_chunk = [&] {
    if (messages.empty()) return;
    const std::string stored = options.compression == "lz4"    ? lz4_compressed(messages)
                               : options.compression == "zstd" ? zstd_compressed(messages)
                                                               : messages;
    file += mcap_record(6, u64(start) + u64(end) + u64(messages.size()) +
                               u32(options.has_crc ? crc_of(messages) : 0) +
                               text(options.compression) + u64(stored.size()) + stored);
    if (options.has_summary) file += mcap_record(7, u16(0) + u32(0));
    messages.clear();
    in_chunk = 0;
    start = ~std::uint64_t{0};
    end = 0;
  };
  if (options.per_chunk == 0) {
    file += definitions(bag);
  } else {
    messages = definitions(bag) + unknown();
  }
  for (const TestMessage& message : bag.messages) {
    const auto time = static_cast<std::uint64_t>(message.time);
    const std::string record =
        mcap_record(5, u16(message.topic) + u32(0) + u64(time) + u64(time) + message.data);
    if (options.per_chunk == 0) {
      file += record;
      continue;
    }
    messages += record;
    start = std::min(start, time);
    end = std::max(end, time);
    if (++in_chunk == options.per_chunk) finish_chunk();
  }
  finish_chunk();
  file += mcap_record(15, u32(options.has_crc ? crc_of(file) : 0));
  std::string summary = options.has_summary ? definitions(bag) + unknown() : "";
  const std::uint64_t summary_start = summary.empty() ? 0 : file.size();
  summary += little(2, 1) + u64(20) + u64(summary_start) + u64(0);
  return file + summary + u32(options.has_crc ? crc_of(summary) : 0) + magic;
}

void write_db3(const TestBag& bag, const std::filesystem::path& path, bool zstd, bool has_index) {
  sqlite3* database = nullptr;
  if (sqlite3_open(path.c_str(), &database) != SQLITE_OK) throw std::runtime_error("sqlite");
  run(database, "PRAGMA page_size = 4096");
  run(database, "BEGIN");
  run(database,
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
      "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)");
  run(database,
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER "
      "NOT NULL, data BLOB NOT NULL)");
  if (has_index) run(database, "CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
  for (std::size_t i = 0; i < bag.topics.size(); ++i) {
    const TestTopic& topic = bag.topics[i];
    run(database, fmt::format("INSERT INTO topics VALUES({}, '{}', '{}', '{}', '')", i + 1,
                              topic.name, topic.type, topic.encoding));
  }
  run(database,
      "CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding "
      "TEXT NOT NULL, encoded_message_definition TEXT NOT NULL)");
  for (const TestTopic& topic : bag.topics) {
    run(database, fmt::format("INSERT INTO message_definitions(topic_type, encoding, "
                              "encoded_message_definition) VALUES('{}', 'ros2msg', '{}')",
                              topic.type, topic.definition));
  }
  sqlite3_stmt* insert = nullptr;
  sqlite3_prepare_v2(database, "INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)",
                     -1, &insert, nullptr);
  for (const TestMessage& message : bag.messages) {
    const std::string data = zstd ? zstd_compressed(message.data) : message.data;
    sqlite3_bind_int64(insert, 1, static_cast<std::int64_t>(message.topic) + 1);
    sqlite3_bind_int64(insert, 2, message.time);
    sqlite3_bind_blob(insert, 3, data.data(), static_cast<int>(data.size()), SQLITE_STATIC);
    sqlite3_step(insert);
    sqlite3_reset(insert);
  }
  sqlite3_finalize(insert);
  run(database, "COMMIT");
  sqlite3_close(database);
}

void run_sql(const std::filesystem::path& path, const std::string& sql) {
  sqlite3* database = nullptr;
  if (sqlite3_open(path.c_str(), &database) != SQLITE_OK) throw std::runtime_error("sqlite");
  run(database, sql);
  sqlite3_close(database);
}

std::string zstd_compressed(std::string_view bytes) {
  std::string out(ZSTD_compressBound(bytes.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 3));
  return out;
}

std::string lz4_compressed(std::string_view bytes) {
  std::string out(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
  out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), nullptr));
  return out;
}

}  // namespace touchdown::test
