#include "logs/log/mcap.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <nlohmann/json.hpp>
#include <optional>

#include <fmt/format.h>

#include "core/error.hpp"
#include "logs/log/annotator.hpp"

namespace touchdown::logs {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");

constexpr std::size_t chunk_bytes = std::size_t{1} << 20U;

template <std::unsigned_integral T>
void put(std::string& bytes, T number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));  // NOLINT
}

/// A text, an array or a map: the number of bytes, then the bytes.
void put(std::string& bytes, std::string_view text) {
  put(bytes, static_cast<std::uint32_t>(text.size()));
  bytes.append(text);
}

template <typename... Parts>
std::string content(const Parts&... parts) {
  std::string bytes;
  (put(bytes, parts), ...);
  return bytes;
}

std::string record_head(McapOp op, std::uint64_t size) {
  return content(static_cast<std::uint8_t>(op), size);
}

std::string record(McapOp op, std::string_view content) {
  return record_head(op, content.size()).append(content);
}

}  // namespace

std::uint32_t mcap_crc(std::string_view bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

void McapWriter::Span::add(std::uint64_t time) {
  start = is_empty ? time : std::min(start, time);
  end = std::max(end, time);
  is_empty = false;
}

McapWriter::McapWriter(std::ostream& stream, std::string_view profile) : stream_(stream) {
  emit(mcap_magic);
  emit(record(McapOp::header, content(profile, std::string_view("touchdown"))));
}

void McapWriter::emit(std::string_view bytes) {
  stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream_) throw Error("the log cannot be written: is the disk full?");
  crc_.process_bytes(bytes.data(), bytes.size());
  position_ += bytes.size();
}

std::uint16_t McapWriter::add_topic(std::string_view topic, std::string_view schema_name,
                                    std::string_view schema, const McapEncoding& encoding) {
  const auto id = static_cast<std::uint16_t>(counts_.size() + 1);
  counts_[id] = 0;
  const std::string of_schema =
      record(McapOp::schema, content(id, schema_name, encoding.schema, schema));
  const std::string of_channel =
      record(McapOp::channel, content(id, id, topic, encoding.message, std::string_view()));
  schemas_ += of_schema;
  channels_ += of_channel;
  emit(of_schema);
  emit(of_channel);
  return id;
}

void McapWriter::write(std::uint16_t topic, std::uint64_t time, std::string_view message) {
  const auto sequence = static_cast<std::uint32_t>(counts_[topic]++);
  index_[topic].emplace_back(time, chunk_.size());
  const std::string head = content(topic, sequence, time, time);
  chunk_.append(record_head(McapOp::message, head.size() + message.size()))
      .append(head)
      .append(message);
  chunk_span_.add(time);
  if (chunk_.size() >= chunk_bytes) finish_chunk();
}

void McapWriter::finish_chunk() {
  if (chunk_.empty()) return;
  const std::uint64_t start = position_;
  const std::string head =
      content(chunk_span_.start, chunk_span_.end, std::uint64_t{chunk_.size()}, mcap_crc(chunk_),
              std::string_view(), std::uint64_t{chunk_.size()});
  emit(record_head(McapOp::chunk, head.size() + chunk_.size()) + head);
  emit(chunk_);
  const std::uint64_t end = position_;
  std::string offsets;
  for (auto& [topic, messages] : index_) {
    std::ranges::stable_sort(messages, {}, &Index::value_type::first);
    std::string entries;
    for (const auto& [time, offset] : messages) entries += content(time, offset);
    offsets += content(topic, position_);
    emit(record(McapOp::message_index, content(topic, std::string_view(entries))));
  }
  chunk_indexes_ += record(McapOp::chunk_index,
                           content(chunk_span_.start, chunk_span_.end, start, end - start,
                                   std::string_view(offsets), position_ - end, std::string_view(),
                                   std::uint64_t{chunk_.size()}, std::uint64_t{chunk_.size()}));
  span_.add(chunk_span_.start);
  span_.add(chunk_span_.end);
  ++chunks_;
  chunk_.clear();
  chunk_span_ = {};
  index_.clear();
}

std::string McapWriter::statistics() const {
  std::uint64_t messages = 0;
  std::string by_topic;
  for (const auto& [topic, count] : counts_) {
    messages += count;
    by_topic += content(topic, count);
  }
  const auto topics = static_cast<std::uint32_t>(counts_.size());
  constexpr std::uint32_t none = 0;  // attachments, metadata
  return record(McapOp::statistics,
                content(messages, static_cast<std::uint16_t>(topics), topics, none, none, chunks_,
                        span_.start, span_.end, std::string_view(by_topic)));
}

void McapWriter::finish() {
  finish_chunk();
  emit(record(McapOp::data_end, content(std::uint32_t{crc_.checksum()})));
  crc_.reset();
  const std::uint64_t summary = position_;
  std::string offsets;
  const auto group = [&](McapOp op, const std::string& records) {
    if (records.empty()) return;
    offsets += record(McapOp::summary_offset, content(static_cast<std::uint8_t>(op), position_,
                                                      std::uint64_t{records.size()}));
    emit(records);
  };
  group(McapOp::schema, schemas_);
  group(McapOp::channel, channels_);
  group(McapOp::statistics, statistics());
  group(McapOp::chunk_index, chunk_indexes_);
  const std::uint64_t summary_offset = position_;
  emit(offsets);
  // The checksum includes the footer up to the checksum.
  const std::string footer = content(summary, summary_offset);
  emit(record_head(McapOp::footer, footer.size() + sizeof(std::uint32_t)) + footer);
  emit(content(std::uint32_t{crc_.checksum()}));
  emit(mcap_magic);
}

namespace {

using Json = nlohmann::ordered_json;

/// The JSON Schema of messages like this one.
Json schema_of(const Json& value) {
  if (value.is_object()) {
    Json properties = Json::object();
    for (const auto& [key, of_key] : value.items()) properties[key] = schema_of(of_key);
    return {{"type", "object"}, {"properties", properties}};
  }
  if (value.is_array()) {
    return {{"type", "array"}, {"items", value.empty() ? Json::object() : schema_of(value[0])}};
  }
  if (value.is_boolean()) return {{"type", "boolean"}};
  if (value.is_string()) return {{"type", "string"}};
  return {{"type", "number"}};  // null, too: a number that is not known yet
}

/// Formats JSON. NaN becomes null; invalid UTF-8 is replaced.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json observation_in(std::string_view record, std::string_view log) {
  try {
    return Json::from_msgpack(record).at("observation");
  } catch (const Json::exception& error) {
    const std::string_view reason = error.what();  // begins with the library's "[json.exception…] "
    throw InputError(fmt::format("{}: a record cannot be written as JSON: {}", log,
                                 reason.substr(std::min(reason.find("] ") + 2, reason.size()))));
  }
}

/// Moves the beliefs out of an observation.
Json beliefs_of(Json& observation) {
  Json beliefs = Json::object();
  for (const std::string_view group : belief_groups) {
    const auto found = observation.find(std::string(group));
    if (found == observation.end()) continue;
    beliefs[std::string(group)] = std::move(*found);
    observation.erase(found);
  }
  return beliefs;
}

}  // namespace

std::string json_schema_of(std::string_view message) {
  return text_of(schema_of(Json::parse(message)));
}

std::uint64_t write_mcap(LogReader& reader, std::ostream& stream, const AddMessages& add) {
  McapWriter writer(stream);
  std::uint16_t of_observation = 0;
  std::uint16_t of_beliefs = 0;
  std::uint64_t rows = 0;
  std::uint64_t time = 0;  // a row without a time gets that of the previous row
  for (; const std::optional<LogRow> row = reader.next(); ++rows) {
    if (std::isfinite(row->observation.time) && reader.stamp() >= 0) {
      time = static_cast<std::uint64_t>(reader.stamp());
    }
    Json observation = observation_in(reader.record(), reader.name());
    const Json beliefs = beliefs_of(observation);
    if (rows == 0) {
      of_observation = writer.add_topic(mcap_observation_topic, mcap_observation_topic + 1,
                                        text_of(schema_of(observation)));
      if (!beliefs.empty()) {
        of_beliefs =
            writer.add_topic(mcap_belief_topic, mcap_belief_topic + 1, text_of(schema_of(beliefs)));
      }
    }
    writer.write(of_observation, time, text_of(observation));
    if (of_beliefs != 0 && !beliefs.empty()) writer.write(of_beliefs, time, text_of(beliefs));
    if (add) add(writer, rows, time);
  }
  writer.finish();
  return rows;
}

}  // namespace touchdown::logs
