#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <fmt/format.h>
#include <msgpack.hpp>

#include "core/error.hpp"
#include "logs/log/packing.hpp"
#include "logs/log/record_source.hpp"

namespace touchdown::logs {

namespace {

constexpr std::uint16_t most_counted = 9999;
constexpr std::size_t chunk_size = std::size_t{1} << 18U;
/// Larger than any record. A longer one is garbage that looks like a header.
constexpr std::size_t largest_record = std::size_t{1} << 23U;

/// Reads the numbers of one record of a log without building the record in memory. Unknown keys are
/// skipped.
class LogParser : public msgpack::null_visitor {
 public:
  enum class Result {
    record,      ///< the bytes begin with a complete record
    incomplete,  ///< the record continues behind the bytes
    garbage,     ///< not a MessagePack map
  };

  LogParser() : tree_([](const LogKey& /*key*/) { return true; }), sequences_(tree_.size()) {
    for (const LogKey& key : log_keys()) {
      if (key.size > 1) vectors_.push_back(&key);
    }
  }

  /// Parses the first record of `bytes`. `length` becomes its size; for garbage, the offset of the
  /// error.
  Result parse(std::string_view bytes, std::size_t& length) {
    length = 0;
    if (bytes.empty()) return Result::incomplete;
    if (map_header_size(bytes.front()) == 0) return Result::garbage;
    present_.reset();
    malformed_.reset();
    flags_.reset();
    texts_.reset();
    given_.fill(0);
    values_.fill(0.0);
    open_.clear();
    current_ = 0;
    element_ = 0;
    in_key_ = has_config_ = incomplete_ = false;
    error_offset_ = 0;
    if (msgpack::parse(bytes.data(), bytes.size(), length, *this)) {
      drop_malformed();
      return Result::record;
    }
    if (incomplete_) return Result::incomplete;
    length = error_offset_;
    return Result::garbage;
  }

  const LogValues& values() const { return values_; }
  /// A vector is present only if it has the right number of elements.
  const LogPresence& present() const { return present_; }
  bool has_config() const { return has_config_; }

  /// Dotted paths of the needed keys that the last record lacks, with the wrong value, if any:
  /// "observation.imu.orientation (3 numbers instead of 4)".
  std::vector<std::string> missing() const {
    std::vector<std::string> paths;
    if (!has_time()) paths.emplace_back("observation.time");
    for (const LogKey& key : log_keys()) {
      if (key.role != LogKey::Role::needed || present_[key.slot]) continue;
      const std::string what = instead(key);
      paths.push_back(what.empty() ? key.path : fmt::format("{} ({})", key.path, what));
    }
    return paths;
  }

  /// \name Called by MessagePack's parser.
  /// @{
  bool visit_boolean(bool value) {
    const LogKey* key = key_here();
    if (key == nullptr || key->role != LogKey::Role::needed) return number(value ? 1.0 : 0.0);
    flags_.set(key->slot);
    malformed_.set(key->slot);
    return true;
  }

  bool visit_positive_integer(std::uint64_t value) { return number(static_cast<double>(value)); }
  bool visit_negative_integer(std::int64_t value) { return number(static_cast<double>(value)); }
  bool visit_float32(float value) { return number(static_cast<double>(value)); }
  bool visit_float64(double value) { return number(value); }

  bool visit_str(const char* text, std::uint32_t size) {
    if (!in_key_) {
      if (const LogKey* key = key_here(); key != nullptr) texts_.set(key->slot);
      return true;
    }
    const std::string_view name(text, size);
    current_ = child(open_.back(), name);
    element_ = 0;
    has_config_ = has_config_ || (open_.size() == 1 && name == "config");
    return true;
  }

  /// A key may be a list; the texts in such a list are not keys.
  bool start_array(std::uint32_t /*elements*/) {
    in_key_ = false;
    return true;
  }

  bool start_map(std::uint32_t /*entries*/) {
    if (current_ != LogKeyTree::none) sequences_[static_cast<std::size_t>(current_)].position = 0;
    open_.push_back(current_);
    return true;
  }

  bool start_map_key() {
    in_key_ = true;
    current_ = LogKeyTree::none;
    return true;
  }

  bool end_map_key() {
    in_key_ = false;
    return true;
  }

  bool end_map() {
    current_ = open_.back();
    open_.pop_back();
    return true;
  }

  void parse_error(std::size_t /*parsed*/, std::size_t offset) { error_offset_ = offset; }

  void insufficient_bytes(std::size_t /*parsed*/, std::size_t /*offset*/) { incomplete_ = true; }

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

  bool number(double value) {
    const LogKey* key = key_here();
    if (key == nullptr) return true;
    if (std::uint16_t& given = given_[key->slot]; given < most_counted) ++given;
    if (element_ < key->size) {
      values_[key->slot + element_] = value;
      present_.set(key->slot + element_);
    } else {
      for (std::size_t i = 0; i < key->size; ++i) malformed_.set(key->slot + i);
    }
    ++element_;
    return true;
  }

  /// The key of the current value; null if it is unknown.
  const LogKey* key_here() const {
    return current_ == LogKeyTree::none || in_key_ ? nullptr : tree_.node(current_).key;
  }

  /// Describes the wrong value at a key; empty if there is no value.
  std::string instead(const LogKey& key) const {
    const char* numbers = key.size == 1 ? "a number" : "numbers";
    if (flags_[key.slot]) return fmt::format("true or false instead of {}", numbers);
    if (texts_[key.slot]) return fmt::format("a text instead of {}", numbers);
    const int given = given_[key.slot];
    if (given == 0) return {};
    return fmt::format("{} number{} instead of {}", given, given == 1 ? "" : "s", key.size);
  }

  int child(int parent, std::string_view name) {
    if (parent == LogKeyTree::none) return LogKeyTree::none;
    // Records of a log are alike: the key is most likely the one at the same position before.
    KeySequence& before = sequences_[static_cast<std::size_t>(parent)];
    const std::size_t position = before.position++;
    if (position < before.keys.size() && before.keys[position].name == name) {
      return before.keys[position].child;
    }
    const std::vector<int>& children = tree_.node(parent).children;
    const auto found = std::find_if(children.begin(), children.end(),
                                    [&](int index) { return tree_.node(index).name == name; });
    const int result = found == children.end() ? LogKeyTree::none : *found;
    constexpr std::size_t most_remembered = 64;
    if (position < before.keys.size()) {
      before.keys[position] = {std::string(name), result};
    } else if (position < most_remembered) {
      before.keys.push_back({std::string(name), result});
    }
    return result;
  }

  void drop_malformed() {
    present_ &= ~malformed_;
    for (const LogKey* vector : vectors_) {
      bool whole = true;
      for (std::size_t i = 0; i < vector->size; ++i) whole = whole && present_[vector->slot + i];
      for (std::size_t i = 0; i < vector->size && !whole; ++i) present_.reset(vector->slot + i);
    }
  }

  bool has_time() const { return present_[log_slot::time] || present_[log_slot::wall_time]; }

  LogKeyTree tree_;
  std::vector<KeySequence> sequences_;  ///< per node of the tree
  std::vector<const LogKey*> vectors_;
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

/// Cuts a stream of bytes into records.
class PackedRecords final : public RecordSource {
 public:
  PackedRecords(ByteSource source, std::string name)
      : source_(std::move(source)), name_(std::move(name)) {}

  bool next() override {
    begin_ += record_size_;
    offset_ += record_size_;
    record_size_ = 0;
    while (true) {
      if (begin_ == end_ && !refill()) return finish();
      const std::string_view bytes(buffer_.data() + begin_, end_ - begin_);
      std::size_t length = 0;
      const LogParser::Result result = parser_.parse(bytes, length);
      if (result == LogParser::Result::record) {
        record_size_ = length;
        has_records_ = true;
        return true;
      }
      if (result == LogParser::Result::garbage || bytes.size() > largest_record) {
        complain_about_garbage(result == LogParser::Result::garbage ? length : 0);
      }
      if (refill()) continue;
      if (!has_records_) complain_about_garbage(0);
      notes().warnings.push_back(
          fmt::format("{}: byte {}: the last record is cut off after {} bytes and was left out",
                      name_, offset_, bytes.size()));
      begin_ = end_;
      return finish();
    }
  }

  const LogValues& values() const override { return parser_.values(); }
  const LogPresence& present() const override { return parser_.present(); }
  std::string_view bytes() const override {
    return std::string_view(buffer_).substr(begin_, record_size_);
  }
  std::string place() const override { return fmt::format("byte {}: ", offset_); }
  std::vector<std::string> missing() const override { return parser_.missing(); }

  void read_origin(std::optional<RecordingInfo>& info, std::string& robot) const override {
    if (record_size_ > 0 && parser_.has_config()) unpack_origin(bytes(), name_, info, robot);
  }

 private:
  bool refill() {
    if (at_end_) return false;
    std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(begin_),
              buffer_.begin() + static_cast<std::ptrdiff_t>(end_), buffer_.begin());
    end_ -= begin_;
    begin_ = 0;
    if (buffer_.size() < end_ + chunk_size) buffer_.resize(2 * (end_ + chunk_size));
    const std::size_t size = source_(std::span(buffer_).subspan(end_, chunk_size));
    end_ += size;
    at_end_ = size == 0;
    return !at_end_;
  }

  bool finish() {
    if (!has_records_) throw InputError(fmt::format("{}: the log is empty", name_));
    return false;
  }

  [[noreturn]] void complain_about_garbage(std::size_t offset) const {
    const bool is_scenario = name_.ends_with(".yaml") || name_.ends_with(".yml");
    throw InputError(fmt::format(
        "{}: byte {}: expected a MessagePack map, one per control step{}", name_, offset_ + offset,
        is_scenario             ? ": `touchdown simulate` makes such a log of a scenario"
        : offset_ + offset == 0 ? ": it is no log in Upkie's layout"
                                : ""));
  }

  ByteSource source_;
  std::string name_;
  LogParser parser_;
  std::string buffer_;
  std::size_t begin_ = 0;        ///< offset of the present record, in the buffer
  std::size_t end_ = 0;          ///< offset behind the bytes read
  std::size_t record_size_ = 0;  ///< of the present record
  std::uint64_t offset_ = 0;     ///< of `begin_` in the log
  bool has_records_ = false;
  bool at_end_ = false;
};

}  // namespace

std::unique_ptr<RecordSource> packed_records(ByteSource source, std::string name) {
  return std::make_unique<PackedRecords>(std::move(source), std::move(name));
}

}  // namespace touchdown::logs
