#include "recordings/log_annotator.hpp"

#include <array>
#include <vector>

#include "core/error.hpp"
#include "recordings/pack_float64.hpp"

namespace touchdown {

namespace {

using Packer = msgpack::packer<msgpack::sbuffer>;

constexpr std::array<std::string_view, 3> groups = {"measurement_model", "transition_model",
                                                    "contact_filter"};

bool is_group(std::string_view key) {
  return key == groups[0] || key == groups[1] || key == groups[2];
}

/// Finds the entries of `observation` in the bytes of a record. MessagePack's parser hands out
/// pointers into the record, which tell where things are.
class ObservationFinder : public msgpack::null_visitor {
 public:
  struct Entry {
    bool is_belief = false;
    const char* begin = nullptr;  ///< of the key
  };

  bool visit_str(const char* text, std::uint32_t size) {
    if (!in_key_) return true;
    const std::string_view key(text, size);
    if (depth_ == 1) {
      in_observation_ = key == "observation";
      if (in_observation_) header = text + size;
      if (!in_observation_ && header != nullptr && end == nullptr) end = key_begin(text, size);
    } else if (depth_ == 2 && in_observation_) {
      entries.push_back({is_group(key), key_begin(text, size)});
    }
    return true;
  }
  bool start_map(std::uint32_t /*size*/) { return ++depth_ > 0; }
  bool end_map() { return --depth_ >= 0; }
  bool start_map_key() { return in_key_ = true; }
  bool end_map_key() {
    in_key_ = false;
    return true;
  }

  const char* header = nullptr;  ///< of the map under `observation`
  const char* end = nullptr;     ///< of that map, if a key follows
  std::vector<Entry> entries;

 private:
  /// A key's header is 1 byte, or more where the writer chose a wider one.
  static const char* key_begin(const char* text, std::uint32_t size) {
    const auto before = [&](int bytes) { return static_cast<unsigned char>(*(text - bytes)); };
    if (size < 32 && before(1) == (0xa0U | size)) return text - 1;
    if (size < 256 && before(1) == size && before(2) == 0xd9U) return text - 2;
    return before(3) == 0xdaU ? text - 3 : text - 5;
  }

  int depth_ = 0;
  bool in_key_ = false;
  bool in_observation_ = false;
};

std::size_t map_header_size(char first) {
  const auto byte = static_cast<unsigned char>(first);
  if ((byte & 0xf0U) == 0x80U) return 1;
  if (byte == 0xdeU) return 3;
  return byte == 0xdfU ? 5 : 0;
}

void pack(Packer& packer, std::string_view key) {
  packer.pack_str(static_cast<std::uint32_t>(key.size()));
  packer.pack_str_body(key.data(), static_cast<std::uint32_t>(key.size()));
}

/// Packs beliefs as three maps of numbers.
class BeliefPacker {
 public:
  BeliefPacker(Packer& packer, msgpack::sbuffer& buffer) : packer_(packer), buffer_(buffer) {}

  void group(std::string_view key, std::uint32_t size) {
    pack(packer_, key);
    packer_.pack_map(size);
  }
  void number(std::string_view key, double value) {
    pack(packer_, key);
    pack_float64(buffer_, value);
  }

 private:
  Packer& packer_;
  msgpack::sbuffer& buffer_;
};

void pack_beliefs(BeliefPacker out, const LogBeliefs& beliefs) {
  out.group(groups[0], 3);
  out.number("contact_likelihood", beliefs.contact_likelihood);
  out.number("no_contact_likelihood", beliefs.no_contact_likelihood);
  out.number("p_contact", beliefs.measurement_p_contact);
  out.group(groups[1], 7);
  out.number("power", beliefs.power);
  out.number("median_frequency", beliefs.median_frequency);
  out.number("filtered_median_freq", beliefs.filtered_median_frequency);
  out.number("p_switch", beliefs.p_switch);
  out.number("p_landing", beliefs.p_landing);
  out.number("p_landing_p_switch", beliefs.p_landing_p_switch);
  out.number("p_takeoff_p_switch", beliefs.p_takeoff_p_switch);
  out.group(groups[2], 2);
  out.number("p_contact", beliefs.p_contact);
  out.number("p_contact_smooth", beliefs.p_contact_smooth);
}

}  // namespace

void LogAnnotator::copy(std::string_view records) {
  stream_.write(records.data(), static_cast<std::streamsize>(records.size()));
  if (!stream_) throw Error("the annotated log cannot be written: is the disk full?");
}

void LogAnnotator::annotate(std::string_view record, const LogBeliefs& beliefs) {
  ObservationFinder found;
  std::size_t length = 0;
  const bool whole = msgpack::parse(record.data(), record.size(), length, found);
  const std::size_t header = found.header == nullptr ? 0 : map_header_size(*found.header);
  if (!whole || length != record.size() || header == 0) {
    throw InputError("a record without an observation cannot be annotated");
  }
  const char* const record_end = record.data() + record.size();
  const char* const end = found.end != nullptr ? found.end : record_end;
  std::size_t kept = 0;
  for (const auto& entry : found.entries) kept += entry.is_belief ? 0U : 1U;

  buffer_.clear();
  buffer_.write(record.data(), static_cast<std::size_t>(found.header - record.data()));
  packer_.pack_map(static_cast<std::uint32_t>(kept + groups.size()));
  for (std::size_t i = 0; i < found.entries.size(); ++i) {
    if (found.entries[i].is_belief) continue;
    const char* const begin = found.entries[i].begin;
    const char* const after = i + 1 < found.entries.size() ? found.entries[i + 1].begin : end;
    buffer_.write(begin, static_cast<std::size_t>(after - begin));
  }
  pack_beliefs({packer_, buffer_}, beliefs);
  buffer_.write(end, static_cast<std::size_t>(record_end - end));
  copy({buffer_.data(), buffer_.size()});
}

}  // namespace touchdown
