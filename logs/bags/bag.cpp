#include "logs/bags/bag.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/resources.hpp"
#include "logs/bags/compression.hpp"
#include "logs/bags/files.hpp"

namespace touchdown::logs {

namespace {

namespace fs = std::filesystem;

/// NAME_10 comes after NAME_9: numbers of more digits are larger.
std::pair<std::size_t, std::string> by_number(const fs::path& file) {
  const std::string name = file.filename().string();
  return {name.size(), name};
}

/// Files that `metadata.yaml` lists. Other keys differ between versions and are not needed. A file
/// that was not written to its end lists none.
std::vector<fs::path> listed_files(const fs::path& metadata) {
  std::vector<fs::path> files;
  try {
    const YAML::Node root = YAML::LoadFile(metadata.string());
    for (const YAML::Node& one : root["rosbag2_bagfile_information"]["relative_file_paths"]) {
      files.emplace_back(one.as<std::string>());
    }
  } catch (const YAML::Exception&) {
    files.clear();
  }
  return files;
}

/// The extension in lower case, without `.zstd`: ".mcap", ".db3", ".bag" or another one.
std::string bag_extension(const fs::path& file) {
  const std::string last = extension_of(file);
  return last == ".zstd" || last == ".zst" ? extension_of(file.stem()) : last;
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const fs::path& entry : entries_in(folder)) {
    const std::string extension = bag_extension(entry);
    if (fs::is_regular_file(entry, ignored) && (extension == ".mcap" || extension == ".db3")) {
      files.push_back(entry);
    }
  }
  std::ranges::sort(files, {}, by_number);
  return files;
}

/// The files of a bag in their order: those of `metadata.yaml`, or without it, as after a crash of
/// the recorder, the folder's `.mcap` or `.db3` files by number; a bare file is its own list.
/// Errors: `InputError` for a folder without such files, or with one missing.
std::vector<fs::path> bag_files(const fs::path& path) {
  if (!is_folder(path)) {
    require_file(path);
    return {path};
  }
  const fs::path metadata = path / "metadata.yaml";
  std::vector<fs::path> files;
  std::error_code ignored;
  if (fs::is_regular_file(metadata, ignored)) files = listed_files(metadata);
  for (fs::path& file : files) {
    const fs::path named = path / file.filename();  // older versions list the folder too
    const fs::path compressed = named.string() + ".zstd";
    file = !is_there(named) && is_there(compressed) ? compressed : named;
    if (!is_there(file)) {
      throw InputError(
          fmt::format("{}: lists {}, which is not there", metadata.string(), named.string()));
    }
  }
  if (files.empty()) {
    files = files_in(path);
    const auto other = std::ranges::find_if(files, [&](const fs::path& file) {
      return bag_extension(file) != bag_extension(files.front());
    });
    if (other != files.end()) {
      throw InputError(fmt::format("{}: {} and {} have two formats: are they two bags? Name one",
                                   path.string(), files.front().filename().string(),
                                   other->filename().string()));
    }
  }
  if (files.empty()) {
    throw InputError(
        fmt::format("{}: expected a ROS 2 bag, a folder with .mcap or .db3 files", path.string()));
  }
  return files;
}

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
    return is_there(path / "metadata.yaml") || !files_in(path).empty();
  }
  const std::string extension = bag_extension(path);
  return extension == ".mcap" || extension == ".db3" || extension == ".bag";
}

BagReader::BagReader(const fs::path& path, TopicFilter wanted, const std::atomic<bool>* stop)
    : wanted_(std::move(wanted)), stop_(stop), files_(bag_files(path)) {}

void BagReader::open_next() {
  const fs::path& named = files_[next_file_++];
  fs::path file = named;
  // It is removed as soon as its reader has it open, so that a killed process leaves none.
  std::optional<PartFolder> plain;
  if (is_zstd(first_bytes(file))) {
    plain.emplace(temporary_folder() / "touchdown_bag");
    file = plain->path() / "plain";
    decompress_file(named, file, stop_);
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
    mcap_ = std::make_unique<McapReader>(file, wanted_, named.string(), stop_);
  } else if (bytes.starts_with("SQLite format 3")) {
    sqlite_ = std::make_unique<SqliteReader>(file, wanted_, named.string(), stop_);
  } else {
    throw InputError(
        fmt::format("{}: is no ROS 2 bag: it begins neither like MCAP nor like SQLite{}",
                    named.string(), bytes.empty() ? ", it is empty" : ""));
  }
}

/// Reads on in the current file. Returns false at its end, which closes it, and without one.
bool BagReader::read(BagMessage& message) {
  if (!mcap_ && !sqlite_) return false;
  const bool is_there = mcap_ ? mcap_->next(message) : sqlite_->next(message);
  // A topic can have another number in each file.
  const std::vector<BagTopic>& of_file = mcap_ ? mcap_->topics() : sqlite_->topics();
  for (std::size_t i = topic_of_.size(); i < of_file.size(); ++i) {
    topic_of_.push_back(topics_.index_of(of_file[i]));
  }
  if (is_there) return true;
  const std::string note = mcap_ ? mcap_->note() : sqlite_->note();
  if (!note.empty()) notes_.push_back(note);
  mcap_.reset();
  sqlite_.reset();
  return false;
}

bool BagReader::next(BagMessage& message) {
  while (!read(message)) {
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

}  // namespace touchdown::logs
