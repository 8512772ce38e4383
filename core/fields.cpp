#include "core/fields.hpp"

#include <algorithm>

#include <fmt/ranges.h>

namespace touchdown {

namespace {

std::string scalar_text(const YAML::Node& value) {
  double number = 0.0;
  if (YAML::convert<double>::decode(value, number)) {
    return std::isfinite(number) ? fmt::format("{}", number) : "none";
  }
  return value.Scalar().empty() ? "\"\"" : value.Scalar();
}

/// The value of a mapping's key; undefined if there is none.
YAML::Node node_of(const YAML::Node& mapping, std::string_view key) {
  if (mapping && mapping.IsMap() && mapping[std::string(key)]) return mapping[std::string(key)];
  return YAML::Node(YAML::NodeType::Undefined);
}

/// The names of the keys whose paths are `prefix` and a name: "" for the first level, or "imu.".
std::vector<std::string> names_at(const std::string& prefix, const std::vector<Key>& keys) {
  std::vector<std::string> names;
  for (const Key& key : keys) {
    if (key.path.starts_with(prefix) &&
        key.path.find_first_of(".[", prefix.size()) == std::string::npos) {
      names.push_back(key.path.substr(prefix.size()));
    }
  }
  return names;
}

/// "time, velocity": the keys of a list's items.
std::string item_keys(const std::function<void(Fields&, std::size_t)>& describe_item) {
  KeyCollection keys;
  Fields item(keys);
  describe_item(item, 0);
  return fmt::format("{}", fmt::join(names_at("", keys.keys()), ", "));
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::size_t KeyCollection::add(Key key) {
  if (required_.contains(key.path)) key.fallback = "required";
  keys_.push_back(std::move(key));
  return keys_.size() - 1;
}

std::string KeyCollection::path_of_open(std::type_index item) const {
  const auto found = std::find_if(open_.begin(), open_.end(),
                                  [&](const auto& list) { return list.first == item; });
  return found == open_.end() ? "" : found->second;
}

const KeyNotes& KeyNotes::doc(std::string_view unit, std::string_view meaning) const {
  set(&Key::unit, unit);
  return doc(meaning);
}

const KeyNotes& KeyNotes::set(std::string Key::*member, std::string_view text) const {
  if (keys_ != nullptr) (*keys_)[index_].*member = text;
  return *this;
}

std::string value_text(const YAML::Node& value) {
  if (value.IsScalar()) return scalar_text(value);
  std::vector<std::string> parts;
  for (const auto& part : value) {
    parts.push_back(
        value.IsMap() ? fmt::format("{}: {}", part.first.as<std::string>(), value_text(part.second))
                      : value_text(part));
  }
  return fmt::format(fmt::runtime(value.IsMap() ? "{{{}}}" : "[{}]"), fmt::join(parts, ", "));
}

std::string range_text(double low, double high) {
  if (std::isinf(high) || high >= 1e15) return fmt::format("≥ {}", low);
  return fmt::format("{} to {}", low, high);
}

Fields::Fields(YAML::Node node, YamlDocument document, std::string path)
    : reading_(true), node_(node), document_(std::move(document)), path_(std::move(path)) {
  if (node_ && !node_.IsNull() && !node_.IsMap()) {
    fail(node_, "", "expected a mapping of keys to values");
  }
}

Fields::Fields(KeyCollection& keys, std::string path)
    : reading_(true), keys_(&keys), path_(std::move(path)) {}

KeyNotes Fields::document(std::string_view key, std::string type, std::string fallback) {
  return {*keys_, keys_->add({.path = path_to(key),
                              .type = std::move(type),
                              .unit = {},
                              .range = {},
                              .fallback = std::move(fallback),
                              .meaning = {}})};
}

KeyNotes Fields::document_list(std::string_view key, std::type_index item_type,
                               std::string fallback,
                               const std::function<void(Fields&)>& describe_item) {
  const std::string nested_in = keys_->path_of_open(item_type);
  if (!nested_in.empty()) return document(key, "list as " + nested_in, std::move(fallback));
  const KeyNotes notes = document(key, "list", std::move(fallback));
  keys_->open(item_type, path_to(key));
  Fields item(*keys_, path_to(key) + "[]");
  describe_item(item);
  keys_->close();
  return notes;
}

void Fields::require(std::string_view key) {
  if (documenting()) keys_->require(path_to(key));
  check(present(key, true), key, "is missing");
}

KeyNotes Fields::choose(std::string_view key, const std::vector<std::string>& names,
                        std::string& value) {
  const KeyNotes notes = (*this)(key, value);
  if (documenting()) notes.type(fmt::format("one of {}", fmt::join(names, ", ")));
  check(contains(names, value), key,
        fmt::format("expected one of {}{}", fmt::join(names, ", "), did_you_mean(value, names)));
  return notes;
}

KeyNotes Fields::choose(std::string_view key, const std::vector<std::string>& names,
                        std::size_t& index) {
  std::string name = names.at(index);
  const KeyNotes notes = choose(key, names, name);
  index = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  return notes;
}

KeyNotes Fields::names(std::string_view key, const std::vector<std::string>& known,
                       std::vector<std::string>& values) {
  const KeyNotes notes = (*this)(key, values);
  if (documenting()) notes.type(fmt::format("list of {}", fmt::join(known, ", ")));
  check(!values.empty(), key, "expected at least one name");
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::string& name = values[i];
    check_item(contains(known, name), key, i,
               fmt::format("'{}' is not one of {}{}", name, fmt::join(known, ", "),
                           did_you_mean(name, known)));
    const auto here = values.begin() + static_cast<std::ptrdiff_t>(i);
    check_item(std::find(values.begin(), here, name) == here, key, i,
               fmt::format("'{}' appears twice", name));
  }
  return notes;
}

KeyNotes Fields::in_line(std::string_view key, std::vector<double>& numbers) {
  const KeyNotes notes = (*this)(key, numbers);
  if (!reading()) node_[std::string(key)].SetStyle(YAML::EmitterStyle::Flow);
  return notes;
}

KeyNotes Fields::within(std::string_view key,
                        const std::function<void(Fields&)>& describe_section) {
  if (documenting()) {
    const KeyNotes notes = document(key, "section", "");
    Fields inner(*keys_, path_to(key));
    describe_section(inner);
    return notes;
  }
  know(key);  // a section without keys may be empty
  Fields inner = reading() ? Fields(node_of(node_, key), document_, path_to(key)) : Fields();
  describe_section(inner);
  inner.finish();
  if (!reading()) node_[std::string(key)] = inner.node();
  return {};
}

void Fields::items(std::string_view key, std::size_t count,
                   const std::function<void(Fields&, std::size_t)>& describe_item) {
  if (reading()) {
    const YAML::Node list = take(key);
    if (list && !list.IsSequence()) {
      fail(key, fmt::format("expected a list of items with the keys {}", item_keys(describe_item)));
    }
    for (std::size_t i = 0; list && i < list.size(); ++i) {
      Fields item(list[i], document_, fmt::format("{}.{}", path_to(key), i));
      describe_item(item, i);
      item.finish();
    }
  } else {
    YAML::Node list(YAML::NodeType::Sequence);
    for (std::size_t i = 0; i < count; ++i) {
      Fields item;
      describe_item(item, i);
      list.push_back(item.node());
    }
    node_[std::string(key)] = list;
  }
}

bool Fields::present(std::string_view key, bool has_value) const {
  if (documenting()) return true;
  return reading() ? has(key) : has_value;
}

void Fields::know(std::string_view key) {
  if (reading() && !contains(known_, std::string(key))) known_.emplace_back(key);
}

std::size_t Fields::size() const { return node_.IsMap() ? node_.size() : 0; }

void Fields::refuse_undocumented(const std::vector<Key>& keys) const {
  const auto known = names_at(path_.empty() ? "" : path_ + ".", keys);
  if (known.empty()) return;
  refuse_all_but(known);
  for (const auto& entry : node_) {
    if (!entry.second.IsMap()) continue;
    Fields(entry.second, document_, path_to(entry.first.Scalar())).refuse_undocumented(keys);
  }
}

void Fields::refuse_all_but(const std::vector<std::string>& known) const {
  if (!reading() || !node_ || !node_.IsMap()) return;
  for (const auto& entry : node_) {
    const auto key = entry.first.as<std::string>();
    if (contains(known, key)) continue;
    std::string hint = did_you_mean(key, known);
    const bool may_be_another_word = hint.empty() || key.size() < 4;
    if (may_be_another_word && !known.empty()) {
      hint += fmt::format(" (known: {})", fmt::join(known, ", "));
    }
    fail(entry.first, key, fmt::format("unknown key{}", hint));
  }
}

void Fields::check(bool holds, std::string_view key, const std::string& message) const {
  if (reading() && !documenting() && !holds) fail(key, message);
}

void Fields::check_item(bool holds, std::string_view key, std::size_t item,
                        const std::string& message) const {
  if (!reading() || documenting() || holds) return;
  const YAML::Node list = node_[std::string(key)];
  fail(list.IsSequence() && item < list.size() ? list[item] : list, key, message);
}

void Fields::check(std::string_view key, const std::function<void()>& action) const {
  if (!reading() || documenting()) return;
  try {
    action();
  } catch (const InputError& error) {
    fail(key, error.what());
  }
}

bool Fields::has(std::string_view key) const { return node_of(node_, key).IsDefined(); }

YAML::Node Fields::take(std::string_view key) {
  know(key);
  YAML::Node given = node_of(node_, key);
  if (given && given.IsNull()) fail(key, "expected a value, found none (a text 'null' in quotes)");
  return given;
}

std::string Fields::path_to(std::string_view key) const {
  return path_.empty() || key.empty() ? path_ + std::string(key) : fmt::format("{}.{}", path_, key);
}

void Fields::fail(std::string_view key, const std::string& message) const {
  const YAML::Node given = node_of(node_, key);
  const bool is_keys_of_name = given && given.IsMap() && message == "expected a text";
  fail(given ? given : node_, key,
       message + (is_keys_of_name ? ", found keys: a file's own keys are set in that file" : ""));
}

void Fields::fail(const YAML::Node& node, std::string_view key, const std::string& message) const {
  const std::string where = path_to(key);
  throw InputError(fmt::format("{}: {}{}{}", document_.place_of(node, where), where,
                               where.empty() ? "" : ": ", message));
}

void Fields::refuse_leading_zeros(const YAML::Node& given, std::string_view key) const {
  if (given.IsSequence()) {
    for (const auto& item : given) refuse_leading_zeros(item, key);
  }
  if (given.IsScalar() && has_leading_zero(given.Scalar())) {
    fail(given, key, fmt::format("{}: a number has no leading zero", given.Scalar()));
  }
}

std::string Fields::expected_range(double low, double high) {
  if (std::isinf(high) || high >= 1e15) return fmt::format("expected a number of at least {}", low);
  return fmt::format("expected a number from {} to {}", low, high);
}

}  // namespace touchdown
