#include <algorithm>

#include <fmt/format.h>

#include "logs/log/packing.hpp"
#include "logs/log/reader.hpp"

namespace touchdown::logs {

namespace {

constexpr std::uint16_t most_counted = 9999;

}  // namespace

LogParser::LogParser()
    : tree_([](const LogKey& /*key*/) { return true; }), sequences_(tree_.size()) {
  for (const LogKey& key : log_keys()) {
    if (key.size > 1) vectors_.push_back(&key);
    if (key.role != LogKey::Role::needed) continue;
    for (std::size_t i = 0; i < key.size; ++i) needed_.set(key.slot + i);
  }
}

LogParser::Result LogParser::parse(std::string_view bytes, std::size_t& length) {
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

void LogParser::drop_malformed() {
  present_ &= ~malformed_;
  for (const LogKey* vector : vectors_) {
    bool whole = true;
    for (std::size_t i = 0; i < vector->size; ++i) whole = whole && present_[vector->slot + i];
    for (std::size_t i = 0; i < vector->size && !whole; ++i) present_.reset(vector->slot + i);
  }
}

bool LogParser::has_time() const {
  return present_[log_slot::time] || present_[log_slot::wall_time];
}

std::vector<std::string> LogParser::missing() const {
  std::vector<std::string> paths;
  if (!has_time()) paths.emplace_back("observation.time");
  for (const LogKey& key : log_keys()) {
    if (key.role != LogKey::Role::needed || present_[key.slot]) continue;
    const std::string what = instead(key);
    paths.push_back(what.empty() ? key.path : fmt::format("{} ({})", key.path, what));
  }
  return paths;
}

std::vector<std::string> LogParser::malformed() const {
  std::vector<std::string> paths = missing();
  std::erase_if(paths, [](const std::string& path) { return !path.ends_with(')'); });
  return paths;
}

/// Describes the wrong value at a key; empty if there is no value.
std::string LogParser::instead(const LogKey& key) const {
  const char* numbers = key.size == 1 ? "a number" : "numbers";
  if (flags_[key.slot]) return fmt::format("true or false instead of {}", numbers);
  if (texts_[key.slot]) return fmt::format("a text instead of {}", numbers);
  const int given = given_[key.slot];
  if (given == 0) return {};
  return fmt::format("{} number{} instead of {}", given, given == 1 ? "" : "s", key.size);
}

/// The key of the current value; null if it is unknown.
const LogKey* LogParser::key_here() const {
  return current_ == LogKeyTree::none || in_key_ ? nullptr : tree_.node(current_).key;
}

bool LogParser::visit_boolean(bool value) {
  const LogKey* key = key_here();
  if (key == nullptr || key->role != LogKey::Role::needed) return number(value ? 1.0 : 0.0);
  flags_.set(key->slot);
  malformed_.set(key->slot);
  return true;
}

bool LogParser::number(double value) {
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

int LogParser::child(int parent, std::string_view name) {
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

bool LogParser::visit_str(const char* text, std::uint32_t size) {
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
bool LogParser::start_array(std::uint32_t /*elements*/) {
  in_key_ = false;
  return true;
}

bool LogParser::start_map(std::uint32_t /*entries*/) {
  if (current_ != LogKeyTree::none) sequences_[static_cast<std::size_t>(current_)].position = 0;
  open_.push_back(current_);
  return true;
}

bool LogParser::start_map_key() {
  in_key_ = true;
  current_ = LogKeyTree::none;
  return true;
}

bool LogParser::end_map_key() {
  in_key_ = false;
  return true;
}

bool LogParser::end_map() {
  current_ = open_.back();
  open_.pop_back();
  return true;
}

void LogParser::parse_error(std::size_t /*parsed*/, std::size_t offset) { error_offset_ = offset; }

void LogParser::insufficient_bytes(std::size_t /*parsed*/, std::size_t /*offset*/) {
  incomplete_ = true;
}

}  // namespace touchdown::logs
