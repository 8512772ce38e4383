#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <msgpack.hpp>

#include "recordings/log/keys.hpp"
#include "recordings/log/row.hpp"

namespace touchdown::recordings {

/// The keys of `observation` under which beliefs are logged.
inline constexpr std::array<std::string_view, 3> belief_groups = {
    "measurement_model", "transition_model", "contact_filter"};

/// Where the `observation` map stands in the bytes of a record, so that beliefs can be written into
/// it without taking the record apart again.
struct ObservationOutline {
  struct Range {
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  /// Offset of the map's header; 0 if the record has no such map.
  std::size_t header = 0;
  /// How many entries the map has.
  std::size_t entries = 0;
  /// Entries that are beliefs already, key and value, in their order.
  std::vector<Range> beliefs;
};

/// Reads the numbers of one record of a log without building the record in memory. Keys that we do
/// not know are skipped.
class LogParser : public msgpack::null_visitor {
 public:
  enum class Result {
    record,      ///< a whole record stands at the beginning of the bytes
    incomplete,  ///< the bytes end before the record does
    garbage,     ///< no MessagePack map
  };

  LogParser();

  /// Parses the first record of `bytes`; `length` becomes its size, or for garbage the offset at
  /// which it stops making sense.
  Result parse(std::string_view bytes, std::size_t& length);

  const LogValues& values() const { return values_; }
  /// A vector is present only when it had the right number of elements.
  const LogPresence& present() const { return present_; }
  const ObservationOutline& outline() const { return outline_; }
  bool has_config() const { return has_config_; }

  /// Dotted paths of the needed keys that the last record lacks.
  std::vector<std::string> missing() const;
  bool is_missing_any() const { return (present_ & needed_) != needed_ || !has_time(); }

  /// \name Called by MessagePack's parser.
  /// @{
  bool visit_boolean(bool value) { return number(value ? 1.0 : 0.0); }
  bool visit_positive_integer(std::uint64_t value) { return number(static_cast<double>(value)); }
  bool visit_negative_integer(std::int64_t value) { return number(static_cast<double>(value)); }
  bool visit_float32(float value) { return number(static_cast<double>(value)); }
  bool visit_float64(double value) { return number(value); }
  bool visit_str(const char* text, std::uint32_t size);
  bool start_map(std::uint32_t entries);
  bool start_map_key();
  bool end_map_key();
  bool end_map();
  void parse_error(std::size_t parsed, std::size_t offset);
  void insufficient_bytes(std::size_t parsed, std::size_t offset);
  /// @}

 private:
  /// The keys that a map had in the record before.
  struct KeySequence {
    struct Key {
      std::string name;
      int child;
    };
    std::vector<Key> keys;
    std::size_t position = 0;
  };

  bool number(double value);
  int child(int parent, std::string_view name);
  void note_place(std::string_view key);
  void end_belief(std::size_t offset);
  void drop_malformed();
  bool has_time() const;

  LogKeyTree tree_;
  std::vector<KeySequence> sequences_;  ///< per node of the tree
  std::vector<const LogKey*> vectors_;
  LogPresence needed_;
  LogPresence present_;
  LogPresence malformed_;
  LogValues values_{};
  std::vector<int> open_;  ///< the maps around the current value
  int current_ = 0;
  std::size_t element_ = 0;
  ObservationOutline outline_;
  const char* record_ = nullptr;
  bool in_observation_ = false;
  bool in_belief_ = false;
  bool in_key_ = false;
  bool has_config_ = false;
  bool incomplete_ = false;
  std::size_t error_offset_ = 0;
};

}  // namespace touchdown::recordings
