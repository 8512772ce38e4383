#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <msgpack.hpp>

#include "recordings/log/keys.hpp"
#include "recordings/log/row.hpp"

namespace touchdown::recordings {

/// Reads the numbers of one record of a log without building the record in memory. Unknown keys are
/// skipped.
class LogParser : public msgpack::null_visitor {
 public:
  enum class Result {
    record,      ///< the bytes begin with a complete record
    incomplete,  ///< the record continues behind the bytes
    garbage,     ///< not a MessagePack map
  };

  LogParser();

  /// Parses the first record of `bytes`. `length` becomes its size; for garbage, the offset of the
  /// error.
  Result parse(std::string_view bytes, std::size_t& length);

  const LogValues& values() const { return values_; }
  /// A vector is present only if it has the right number of elements.
  const LogPresence& present() const { return present_; }
  bool has_config() const { return has_config_; }

  /// Dotted paths of the needed keys that the last record lacks, with the wrong value, if any:
  /// "observation.imu.orientation (3 numbers instead of 4)".
  std::vector<std::string> missing() const;
  bool is_missing_any() const { return (present_ & needed_) != needed_ || !has_time(); }
  /// Those of them with a wrong value.
  std::vector<std::string> malformed() const;

  /// \name Called by MessagePack's parser.
  /// @{
  bool visit_boolean(bool value);
  bool visit_positive_integer(std::uint64_t value) { return number(static_cast<double>(value)); }
  bool visit_negative_integer(std::int64_t value) { return number(static_cast<double>(value)); }
  bool visit_float32(float value) { return number(static_cast<double>(value)); }
  bool visit_float64(double value) { return number(value); }
  bool visit_str(const char* text, std::uint32_t size);
  bool start_array(std::uint32_t elements);
  bool start_map(std::uint32_t entries);
  bool start_map_key();
  bool end_map_key();
  bool end_map();
  void parse_error(std::size_t parsed, std::size_t offset);
  void insufficient_bytes(std::size_t parsed, std::size_t offset);
  /// @}

 private:
  /// The keys of a map in the previous record.
  struct KeySequence {
    struct Key {
      std::string name;
      int child;
    };
    std::vector<Key> keys;
    std::size_t position = 0;
  };

  bool number(double value);
  const LogKey* key_here() const;
  std::string instead(const LogKey& key) const;
  int child(int parent, std::string_view name);
  void drop_malformed();
  bool has_time() const;

  LogKeyTree tree_;
  std::vector<KeySequence> sequences_;  ///< per node of the tree
  std::vector<const LogKey*> vectors_;
  LogPresence needed_;
  LogPresence present_;
  LogPresence malformed_;
  LogPresence flags_;  ///< true or false instead of numbers
  LogPresence texts_;  ///< text instead of numbers
  std::array<std::uint16_t, log_slot::count>
      given_{};  ///< number of elements of a key, by its first slot
  LogValues values_{};
  std::vector<int> open_;  ///< the maps around the current value
  int current_ = 0;
  std::size_t element_ = 0;
  bool in_key_ = false;
  bool has_config_ = false;
  bool incomplete_ = false;
  std::size_t error_offset_ = 0;
};

}  // namespace touchdown::recordings
