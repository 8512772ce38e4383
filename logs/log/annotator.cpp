#include "logs/log/annotator.hpp"

#include <algorithm>
#include <cstdint>

#include "core/error.hpp"

namespace touchdown::logs {

namespace {

enum class Kind : std::uint8_t { other, text, list, map };

/// The bytes that follow a value's first byte: a length, bytes of fixed number, then as many bytes
/// or values as the length specifies.
struct Format {
  std::uint8_t length_bytes = 0;  ///< size of the length
  std::uint8_t extra = 0;         ///< fixed number of bytes
  Kind kind = Kind::other;
};

// clang-format off
/// Formats of the first bytes 0xc0 to 0xdf in MessagePack's specification. All other first bytes
/// contain their length.
constexpr std::array<Format, 32> formats = {{
    {}, {}, {}, {},                                                // nil, nothing, booleans
    {1}, {2}, {4}, {1, 1}, {2, 1}, {4, 1},                         // bin, ext
    {0, 4}, {0, 8},                                                // floats
    {0, 1}, {0, 2}, {0, 4}, {0, 8}, {0, 1}, {0, 2}, {0, 4}, {0, 8},  // unsigned, signed
    {0, 2}, {0, 3}, {0, 5}, {0, 9}, {0, 17},                       // fixext
    {1, 0, Kind::text}, {2, 0, Kind::text}, {4, 0, Kind::text},
    {2, 0, Kind::list}, {4, 0, Kind::list}, {2, 0, Kind::map}, {4, 0, Kind::map},
}};
// clang-format on

struct Value {
  Kind kind = Kind::other;
  std::size_t end = 0;       ///< offset behind the value, without nested values
  std::uint64_t inside = 0;  ///< number of nested values
  std::string_view text;
};

Value value_at(std::string_view bytes, std::size_t at) {
  const auto need = [&](std::size_t begin, std::uint64_t size) {
    if (begin > bytes.size() || size > bytes.size() - begin) {
      throw InputError("a record of the log is cut off");
    }
  };
  need(at, 1);
  const auto first = static_cast<unsigned char>(bytes[at]);
  Value value;
  value.end = at + 1;
  std::uint64_t length = 0;
  if (first >= 0x80U && first < 0x90U) {
    value.kind = Kind::map;
    length = first & 0x0fU;
  } else if (first >= 0x90U && first < 0xa0U) {
    value.kind = Kind::list;
    length = first & 0x0fU;
  } else if (first >= 0xa0U && first < 0xc0U) {
    value.kind = Kind::text;
    length = first & 0x1fU;
  } else if (first >= 0xc0U && first < 0xe0U) {
    const Format& format = formats[first - 0xc0U];
    need(value.end, format.length_bytes);
    for (std::size_t i = 0; i < format.length_bytes; ++i) {
      length = length << 8U | static_cast<unsigned char>(bytes[value.end++]);
    }
    value.kind = format.kind;
    need(value.end, format.extra);
    value.end += format.extra;
  }
  if (value.kind == Kind::map || value.kind == Kind::list) {
    value.inside = value.kind == Kind::map ? 2 * length : length;
    return value;
  }
  need(value.end, length);
  if (value.kind == Kind::text) value.text = bytes.substr(value.end, length);
  value.end += length;
  return value;
}

/// The offset behind the value at `at`, nested values included.
std::size_t skip(std::string_view bytes, std::size_t at) {
  for (std::uint64_t left = 1; left > 0; --left) {
    const Value value = value_at(bytes, at);
    at = value.end;
    left += value.inside;
  }
  return at;
}

/// Calls `visit(key, begin, value)` for every entry of the map at `at`, with the key and the
/// offsets of the entry and of its value. Returns the offset behind the map.
template <typename Visit>
std::size_t for_each_entry(std::string_view bytes, std::size_t at, const Visit& visit) {
  const Value map = value_at(bytes, at);
  at = map.end;
  for (std::uint64_t i = 0; i < map.inside / 2; ++i) {
    const std::size_t value = skip(bytes, at);
    visit(value_at(bytes, at), at, value);
    at = skip(bytes, value);
  }
  return at;
}

ObservationOutline outline_of_map(std::string_view bytes, std::size_t header) {
  ObservationOutline outline;
  outline.header = header;
  for_each_entry(bytes, header, [&](const Value& key, std::size_t begin, std::size_t value) {
    ++outline.entries;
    if (key.kind != Kind::text) return;
    if (std::find(belief_groups.begin(), belief_groups.end(), key.text) == belief_groups.end()) {
      return;
    }
    outline.beliefs.push_back({begin, skip(bytes, value)});
  });
  return outline;
}

}  // namespace

ObservationOutline outline_of(std::string_view record) {
  ObservationOutline outline;
  if (record.empty() || value_at(record, 0).kind != Kind::map) return outline;
  for_each_entry(record, 0, [&](const Value& key, std::size_t /*begin*/, std::size_t value) {
    if (key.kind != Kind::text || key.text != "observation") return;
    if (value_at(record, value).kind == Kind::map) outline = outline_of_map(record, value);
  });
  return outline;
}

namespace {

/// Packs a belief as three maps.
void pack_beliefs(LogPacker& packer, msgpack::sbuffer& buffer, const Belief& belief,
                  const Evidence& evidence) {
  const auto group = [&](std::string_view key, std::uint32_t size) {
    pack_text(packer, key);
    packer.pack_map(size);
  };
  const auto number = [&](std::string_view key, double value) {
    pack_text(packer, key);
    pack_float64(buffer, value);
  };
  const auto wheel = [&](std::string_view key, const WheelBelief& of_wheel) {
    group(key, 4);
    number("p_contact", of_wheel.p_contact);
    pack_text(packer, "contact");
    of_wheel.contact ? packer.pack_true() : packer.pack_false();
    number("load", of_wheel.load.force);
    number("load_deviation", of_wheel.load.deviation);
  };
  const Evidence::Measurement& measurement = evidence.wheel[0];
  const Evidence::Transition& transition = evidence.transition;
  group(belief_groups[0], 3);
  number("contact_likelihood", measurement.contact_likelihood);
  number("no_contact_likelihood", measurement.no_contact_likelihood);
  number("p_contact", measurement.p_contact);
  group(belief_groups[1], 7);
  number("power", transition.power);
  number("median_frequency", transition.median_frequency);
  number("filtered_median_freq", transition.filtered_median_frequency);
  number("p_switch", transition.p_switch);
  number("p_landing", transition.p_landing_if_switch);
  number("p_landing_p_switch", transition.p_landing);
  number("p_takeoff_p_switch", transition.p_takeoff);
  group(belief_groups[2], 7);
  number("p_contact", belief.wheel[0].p_contact);
  number("p_contact_smooth", Evidence::unknown);
  wheel("left_wheel", belief.wheel[0]);
  wheel("right_wheel", belief.wheel[1]);
  number("p_any_wheel", belief.p_any_wheel);
  number("p_both_wheels", belief.p_both_wheels);
  pack_text(packer, "status");
  pack_text(packer, to_text(belief.status));
}

}  // namespace

void LogAnnotator::copy(std::string_view records) {
  stream_.write(records.data(), static_cast<std::streamsize>(records.size()));
  if (!stream_) throw Error("the annotated log cannot be written: is the disk full?");
}

void LogAnnotator::annotate(std::string_view record, const Belief& belief,
                            const Evidence& evidence) {
  const ObservationOutline outline = outline_of(record);
  if (outline.header == 0) throw InputError("a record without an observation cannot be annotated");
  const std::size_t header_size = map_header_size(record[outline.header]);

  buffer_.clear();
  buffer_.write(record.data(), outline.header);
  packer_.pack_map(
      static_cast<std::uint32_t>(outline.entries - outline.beliefs.size() + belief_groups.size()));
  pack_beliefs(packer_, buffer_, belief, evidence);
  std::size_t copied = outline.header + header_size;
  for (const ObservationOutline::Range& old : outline.beliefs) {
    buffer_.write(record.data() + copied, old.begin - copied);
    copied = old.end;
  }
  buffer_.write(record.data() + copied, record.size() - copied);
  copy({buffer_.data(), buffer_.size()});
}

}  // namespace touchdown::logs
