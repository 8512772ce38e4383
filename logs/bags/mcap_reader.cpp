#include "logs/bags/mcap_reader.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"

namespace touchdown::logs {

namespace {

/// Largest size of the chunks in memory, which is that of the chunks that overlap in time.
constexpr std::uint64_t most_loaded_bytes = std::uint64_t{1} << 30U;

}  // namespace

McapReader::McapReader(const std::filesystem::path& path, TopicFilter wanted,
                       const std::string& name, const std::atomic<bool>* stop)
    : file_(path, name.empty() ? path.string() : name, stop),
      wanted_(std::move(wanted)),
      layout_(mcap_layout(file_)) {
  if (layout_.is_in_file_order) return;
  // The definition of a channel can be in a later part than its first message.
  std::vector<McapPart> parts = layout_.parts;
  std::sort(parts.begin(), parts.end(),
            [](const McapPart& a, const McapPart& b) { return a.offset < b.offset; });
  for (const McapPart& part : parts) {
    with_place(part, [&] {
      for_each_mcap_record(records_of(part), [&](McapOp op, std::string_view content) {
        if (op == McapOp::schema) layout_.channels.add_schema(content);
        if (op == McapOp::channel) layout_.channels.add_channel(content);
      });
    });
  }
}

/// Names the part in errors.
void McapReader::with_place(const McapPart& part, const std::function<void()>& use) const {
  try {
    use();
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: byte {}: {}: {}", file_.name(), part.offset,
                                 part.is_chunk ? "chunk" : "records", error.what()));
  }
}

/// The uncompressed records of a part.
std::string McapReader::records_of(const McapPart& part) {
  std::string bytes;
  file_.read(part.offset, part.size, bytes);
  if (!part.is_chunk) return bytes;
  McapChunk chunk;
  try {
    chunk = mcap_chunk(bytes);
  } catch (const InputError&) {
    if (part.is_cut) return {};
    throw;
  }
  if (!part.is_cut && chunk.records.size() < chunk.size) {
    throw InputError(
        fmt::format("expected {} bytes of messages, found {}", chunk.size, chunk.records.size()));
  }
  Decompressed result = decompress(chunk.compression, chunk.records,
                                   std::min(chunk.uncompressed_size, most_loaded_bytes));
  if (part.is_cut) return std::move(result.bytes);
  if (!result.fault.empty()) throw InputError(result.fault);
  if (result.bytes.size() < chunk.uncompressed_size) {
    throw InputError(fmt::format("expected {} bytes of messages, found {}", chunk.uncompressed_size,
                                 result.bytes.size()));
  }
  if (chunk.crc != 0 && mcap_crc(result.bytes) != chunk.crc) {
    throw InputError("its checksum differs: the file is damaged");
  }
  return std::move(result.bytes);
}

std::size_t McapReader::topic_of(std::uint16_t channel) {
  const auto known = topic_of_channel_.find(channel);
  if (known != topic_of_channel_.end()) return known->second;
  const auto defined = layout_.channels.channel.find(channel);
  if (defined == layout_.channels.channel.end()) {
    throw InputError(fmt::format("a message is of channel {}, which is not defined", channel));
  }
  const McapChannels::Channel& of = defined->second;
  const auto schema = layout_.channels.schema.find(of.schema);
  BagTopic topic{of.topic, "", of.encoding};
  if (schema != layout_.channels.schema.end()) {
    topic.type = schema->second.name;
    if (schema->second.encoding == "ros2msg") topic.definition = schema->second.text;
  }
  return topic_of_channel_[channel] = topics_.index_of(topic);
}

void McapReader::load(const McapPart& part) {
  Loaded loaded;
  const auto use = [&](McapOp op, std::string_view content) {
    if (op == McapOp::schema) layout_.channels.add_schema(content);
    if (op == McapOp::channel) layout_.channels.add_channel(content);
    if (op != McapOp::message) return;
    const McapMessage message = mcap_message(content);
    const std::size_t topic = topic_of(message.channel);
    if (part.is_cut) ++cut_messages_;
    if (wanted_ && !wanted_(topics_[topic].name)) {
      ++topics_[topic].messages;
      return;
    }
    loaded.entries.push_back({message.log_time, topic,
                              static_cast<std::size_t>(message.data.data() - loaded.bytes.data()),
                              message.data.size()});
  };
  with_place(part, [&] {
    loaded.bytes = records_of(part);
    const std::size_t whole = for_each_mcap_record(loaded.bytes, use);
    if (whole < loaded.bytes.size() && !part.is_cut) {
      throw InputError("its last record ends beyond it");
    }
  });
  std::stable_sort(loaded.entries.begin(), loaded.entries.end(),
                   [](const Entry& a, const Entry& b) { return a.time < b.time; });
  if (loaded.is_done()) return;
  loaded_bytes_ += loaded.bytes.size();
  if (loaded_bytes_ > most_loaded_bytes) {
    throw InputError(fmt::format(
        "{}: more than {} MiB of messages overlap in time: sort the bag with `mcap sort`",
        file_.name(), most_loaded_bytes >> 20U));
  }
  const Place place(loaded.entries.front().time, part.offset);
  loaded_.emplace(place, std::move(loaded));
}

/// The message that was read last is valid until now.
void McapReader::leave_last_message() {
  if (!std::exchange(is_first_read_, false)) return;
  auto part = loaded_.extract(loaded_.begin());
  const Loaded& loaded = part.mapped();
  if (loaded.is_done()) {
    loaded_bytes_ -= loaded.bytes.size();
    return;
  }
  part.key().first = loaded.entries[loaded.next].time;
  loaded_.insert(std::move(part));
}

bool McapReader::next(BagMessage& message) {
  leave_last_message();
  const std::vector<McapPart>& parts = layout_.parts;
  while (next_part_ < parts.size() &&
         (loaded_.empty() || parts[next_part_].start <= loaded_.begin()->first.first)) {
    load(parts[next_part_++]);
  }
  if (loaded_.empty()) return false;
  is_first_read_ = true;
  Loaded& first = loaded_.begin()->second;
  const Entry& entry = first.entries[first.next++];
  ++topics_[entry.topic].messages;
  message.topic = entry.topic;
  message.time = static_cast<std::int64_t>(entry.time);
  message.data = std::string_view(first.bytes).substr(entry.offset, entry.size);
  return true;
}

std::string McapReader::note() const {
  if (layout_.end_missing.empty()) return {};
  return fmt::format("{}: {}{}", file_.name(), layout_.end_missing,
                     cut_messages_ == 0
                         ? std::string()
                         : fmt::format("; {} messages before it were read", cut_messages_));
}

}  // namespace touchdown::logs
