#include "recordings/bags/bag.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "recordings/bags/bag_files.hpp"
#include "recordings/bags/storage/compression.hpp"
#include "recordings/bags/storage/random_file.hpp"

namespace touchdown::recordings {

namespace {

namespace fs = std::filesystem;

/// Largest payload of a message that is compressed.
constexpr std::uint64_t most_payload_bytes = std::uint64_t{1} << 28U;

std::string first_bytes(const fs::path& path) {
  std::string bytes;
  RandomFile(path, path.string()).read(0, 16, bytes);
  return bytes;
}

}  // namespace

bool is_bag(const fs::path& path) {
  if (is_folder(path)) {
    if (is_there(path / "metadata.yaml")) return true;
    const std::vector<fs::path> entries = entries_in(path);
    return std::any_of(entries.begin(), entries.end(), [](const fs::path& entry) {
      const std::string extension = bag_extension(entry);
      return extension == ".mcap" || extension == ".db3";
    });
  }
  const std::string extension = bag_extension(path);
  return extension == ".mcap" || extension == ".db3" || extension == ".bag";
}

BagReader::BagReader(const fs::path& path, TopicFilter wanted)
    : wanted_(std::move(wanted)), files_(bag_files(path)) {}

void BagReader::close() {
  mcap_.reset();
  sqlite_.reset();
  temporary_.reset();
}

void BagReader::open_next() {
  const fs::path& named = files_[next_file_++];
  fs::path file = named;
  if (is_zstd(first_bytes(file))) {
    const fs::path& plain = temporary_.emplace().path();
    decompress_file(file, plain);
    file = plain;
  }
  const std::string bytes = first_bytes(file);
  if (bytes.starts_with("#ROSBAG")) {
    throw InputError(
        fmt::format("{0}: is a ROS 1 bag. Convert it first: pip install rosbags, then "
                    "rosbags-convert --src {0} "
                    "--dst {1}",
                    named.string(), (named.parent_path() / named.stem()).string()));
  }
  topic_of_.clear();
  if (bytes.starts_with(mcap_magic)) {
    mcap_ = std::make_unique<McapReader>(file, wanted_, named.string());
  } else if (bytes.starts_with("SQLite format 3")) {
    sqlite_ = std::make_unique<SqliteReader>(file, wanted_, named.string());
  } else {
    throw InputError(
        fmt::format("{}: is no ROS 2 bag: it begins neither like MCAP nor like SQLite{}",
                    named.string(), bytes.empty() ? ", it is empty" : ""));
  }
}

/// Adds the topics of the current file. A topic can have another number in each file.
void BagReader::update_topics(const std::vector<BagTopic>& of_file) {
  for (std::size_t i = topic_of_.size(); i < of_file.size(); ++i) {
    const auto known = std::find_if(topics_.begin(), topics_.end(), [&](const BagTopic& topic) {
      return topic.name == of_file[i].name && topic.type == of_file[i].type &&
             topic.encoding == of_file[i].encoding;
    });
    topic_of_.push_back(static_cast<std::size_t>(known - topics_.begin()));
    if (known == topics_.end()) {
      topics_.push_back({of_file[i].name, of_file[i].type, of_file[i].encoding, 0});
    }
  }
}

bool BagReader::read(BagMessage& message) {
  const bool is_there = mcap_ ? mcap_->next(message) : sqlite_->next(message);
  update_topics(mcap_ ? mcap_->topics() : sqlite_->topics());
  if (is_there) return true;
  const std::string note = mcap_ ? mcap_->note() : sqlite_->note();
  if (!note.empty()) notes_.push_back(note);
  return false;
}

bool BagReader::next(BagMessage& message) {
  while (true) {
    if (mcap_ || sqlite_) {
      if (read(message)) break;
      close();
    }
    if (next_file_ == files_.size()) return false;
    open_next();
  }
  message.topic = topic_of_[message.topic];
  ++topics_[message.topic].messages;
  if (is_zstd(message.data)) {
    Decompressed payload = decompress(Compression::zstd, message.data, most_payload_bytes);
    if (!payload.fault.empty()) {
      throw InputError(fmt::format("{}: a message of {} cannot be decompressed: {}",
                                   files_[next_file_ - 1].string(), topics_[message.topic].name,
                                   payload.fault));
    }
    decompressed_ = std::move(payload.bytes);
    message.data = decompressed_;
  }
  return true;
}

}  // namespace touchdown::recordings
