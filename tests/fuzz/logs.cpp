#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "estimator/npz/npz.hpp"
#include "logs/bags/mcap_reader.hpp"
#include "logs/bags/sqlite_reader.hpp"
#include "logs/bags/topic_rows.hpp"
#include "logs/log/annotator.hpp"
#include "logs/log/beliefs.hpp"
#include "logs/log/contact_intervals.hpp"
#include "logs/log/reader.hpp"
#include "logs/mapping/conversion.hpp"
#include "logs/signals_from.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::fuzz {

/// Bytes read as every format of beliefs, and as a person's contact labels.
TOUCHDOWN_FUZZ(beliefs) {
  const MemoryFile file(input);
  const std::filesystem::path path = file.path();
  for (const std::function<void()>& read : std::initializer_list<std::function<void()>>{
           [&] { (void)logs::read_belief_csv(path); }, [&] { (void)logs::read_belief_mpack(path); },
           [&] { (void)logs::read_belief_npz(path); },
           [&] { (void)logs::read_contact_intervals(path); }}) {
    try {
      read();
    } catch (const Error& error) {
      expected(error, input);
    }
  }
}

/// A payload in CDR, as a JointState and as an Imu, twice: the second one is held against the
/// first.
TOUCHDOWN_FUZZ(cdr) {
  for (const char* const type : {logs::joint_state_type, logs::imu_type}) {
    logs::SignalTopic topic;
    topic.type = type;
    topic.joints = {"a", "b"};
    topic.definition = std::make_shared<const logs::MessageType>(type, "");
    std::vector<logs::TopicColumn> columns{{logs::stamp_column, true}};
    for (const std::string& name : topic.columns()) columns.push_back({name});
    logs::TopicRows rows(topic, columns, {});
    for (const std::int64_t time : {std::int64_t{0}, std::int64_t{1'000'000}}) {
      const bool is_row = rows.update({0, time, input});
      if (is_row && rows.malformed() > 0) __builtin_trap();
    }
  }
}

namespace {

/// Reads a log as `touchdown estimate` does and writes beliefs into it. `chunk` is the number of
/// bytes per read, as from a live stream; 0: all.
struct Annotated {
  std::size_t rows = 0;
  std::string log;
};

Annotated annotated(std::string_view bytes, std::size_t chunk) {
  const logs::ByteSource source = [&](std::span<char> buffer) {
    const std::size_t most = chunk == 0 ? buffer.size() : std::min(buffer.size(), chunk);
    const std::size_t size = bytes.copy(buffer.data(), most);
    bytes.remove_prefix(size);
    return size;
  };
  logs::LogReader reader(source, "fuzz.mpack");
  (void)reader.info();
  std::ostringstream out;
  logs::LogAnnotator annotator(out);
  Annotated result;
  while (const std::optional<logs::LogRow> row = reader.next()) {
    (void)logs::signals_from(row->observation, logs::ground_velocity_command(row->action));
    annotator.copy(reader.skipped());
    annotator.annotate(reader.record(), {}, {});
    ++result.rows;
  }
  annotator.copy(reader.skipped());
  result.log = out.str();
  return result;
}

}  // namespace

/// A log, annotated and read again. The first byte times 16 is the chunk size.
TOUCHDOWN_FUZZ(log) {
  if (input.empty()) return;
  const auto chunk = 16 * static_cast<std::size_t>(static_cast<unsigned char>(input.front()));
  const Annotated once = annotated(input.substr(1), chunk);
  const auto rows_again = [&]() noexcept { return annotated(once.log, 0).rows; };
  if (once.rows != 0 && rows_again() != once.rows) __builtin_trap();
}

namespace {

/// A file in memory with a name, which decides the format.
class NamedMemoryFile {
 public:
  explicit NamedMemoryFile(const std::filesystem::path& path) : path_(path) {
    std::filesystem::create_symlink(memory_.path(), path);
  }
  const std::filesystem::path& with(std::string_view content) {
    memory_.set_content(content);
    return path_;
  }

 private:
  MemoryFile memory_;
  std::filesystem::path path_;
};

/// Reads the data of every message of a bag.
void read_all(auto& reader) {
  logs::BagMessage message;
  std::size_t bytes = 0;
  while (reader.next(message)) {
    for (const char c : message.data) bytes += static_cast<unsigned char>(c);
  }
  if (bytes == 1 && reader.note().empty()) return;  // the data were read
}

/// The inputs before and behind a line of dashes.
std::array<std::string_view, 2> halves(std::string_view input) {
  constexpr std::string_view between = "\n---\n";
  const std::size_t end = std::min(input.find(between), input.size());
  return {input.substr(0, end), input.substr(std::min(end + between.size(), input.size()))};
}

}  // namespace

/// A mapping file, a line of dashes, and the log that it maps.
TOUCHDOWN_FUZZ(mapping) {
  static const ScratchFolder folder;
  static NamedMemoryFile log(folder / "log.csv");
  static NamedMemoryFile mapping(folder / "map.yaml");
  const auto [map, rows] = halves(input);
  std::ostringstream stream;
  (void)logs::convert_log(log.with(rows), mapping.with(map), stream, {.with_labels = true});
}

/// The definition of a type, a line of dashes, and a message of it in CDR, which is read twice: the
/// second time without its paths.
TOUCHDOWN_FUZZ(message_type) {
  const auto [definition, payload] = halves(input);
  const logs::MessageType type("my_msgs/msg/State", definition);
  logs::MessageNumbers numbers;
  for (int times = 0; times < 2; ++times) {
    type.decode(payload, numbers);
    if (numbers.paths.size() != numbers.values.size()) __builtin_trap();
  }
  (void)numbers.stamp();
}

/// An MCAP file.
TOUCHDOWN_FUZZ(mcap) {
  const MemoryFile file(input);
  logs::McapReader reader(file.path());
  read_all(reader);
}

/// A `.npy`; its array is written and read again.
TOUCHDOWN_FUZZ(npy) {
  const ModelArray array = from_npy(input, "fuzz.npy");
  const ModelArray again = [&]() noexcept { return from_npy(to_npy(array), "again.npy"); }();
  if (again.shape != array.shape || again.data.size() != array.data.size()) __builtin_trap();
}

/// A raw `.npz`.
TOUCHDOWN_FUZZ(npz) {
  const MemoryFile file(input);
  (void)npz_names(file.path());
  (void)read_npz(file.path());
}

/// A SQLite bag. SQLite needs a file with a name.
TOUCHDOWN_FUZZ(sqlite_bag) {
  static const ScratchFolder folder;
  const std::filesystem::path path = folder / "bag.db3";
  std::ofstream(path, std::ios::binary) << input;
  logs::SqliteReader reader(path);
  read_all(reader);
}

}  // namespace touchdown::fuzz
