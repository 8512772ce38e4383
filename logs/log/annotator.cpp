#include "logs/log/annotator.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/error.hpp"

namespace touchdown::logs {

namespace {

/// The first token of a value, if it is a text or the head of a map.
struct Token : msgpack::null_visitor {
  std::string_view text;
  std::uint32_t entries = 0;  ///< of the map

  bool visit_str(const char* begin, std::uint32_t size) {
    text = {begin, size};
    return true;
  }
  bool start_array(std::uint32_t /*elements*/) { return false; }
  bool start_map(std::uint32_t count) {
    entries = count;
    return false;
  }
};

Token token_at(std::string_view bytes, std::size_t at) {
  Token token;
  (void)msgpack::parse(bytes.data(), bytes.size(), at, token);
  return token;
}

/// The offset behind the value at `at`, nested values included.
std::size_t skip(std::string_view bytes, std::size_t at) {
  msgpack::null_visitor visitor;
  if (msgpack::parse(bytes.data(), bytes.size(), at, visitor)) return at;
  throw InputError("a record of the log is cut off");
}

/// An entry of a map: from its key to the end of its value.
struct Entry {
  std::string_view key;  ///< empty for one that is no text
  std::size_t begin = 0;
  std::size_t value = 0;
  std::size_t end = 0;
};

/// The entries of the map at `at`; none of another value.
std::vector<Entry> entries_of(std::string_view bytes, std::size_t at) {
  std::vector<Entry> entries;
  const std::uint32_t count = token_at(bytes, at).entries;
  if (count > 0) at += map_header_size(bytes[at]);
  while (entries.size() < count) {
    const std::size_t value = skip(bytes, at);
    entries.push_back({token_at(bytes, at).text, at, value, skip(bytes, value)});
    at = entries.back().end;
  }
  return entries;
}

bool is_belief(const Entry& entry) {
  return std::ranges::find(belief_groups, entry.key) != belief_groups.end();
}

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
  // Beliefs are inserted without decoding the record. Of several observations the last one counts.
  std::size_t observation = 0;
  for (const Entry& entry : entries_of(record, 0)) {
    const bool is_map = map_header_size(record[entry.value]) > 0;
    if (is_map && entry.key == "observation") observation = entry.value;
  }
  if (observation == 0) throw InputError("a record without an observation cannot be annotated");
  const std::vector<Entry> entries = entries_of(record, observation);
  const auto old = std::ranges::count_if(entries, is_belief);

  buffer_.clear();
  buffer_.write(record.data(), observation);
  packer_.pack_map(static_cast<std::uint32_t>(entries.size() - static_cast<std::size_t>(old) +
                                              belief_groups.size()));
  pack_beliefs(packer_, buffer_, belief, evidence);
  std::size_t copied = observation + map_header_size(record[observation]);
  for (const Entry& entry : entries) {
    if (!is_belief(entry)) continue;
    buffer_.write(record.data() + copied, entry.begin - copied);
    copied = entry.end;
  }
  buffer_.write(record.data() + copied, record.size() - copied);
  copy({buffer_.data(), buffer_.size()});
}

}  // namespace touchdown::logs
