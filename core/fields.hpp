#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <typeindex>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "core/key.hpp"
#include "core/yaml.hpp"

namespace touchdown {

/// The keys of one kind of file, in the order of their description.
class KeyCollection {
 public:
  /// Adds a key and returns its index. The fallback of a required key is "required".
  std::size_t add(Key key);
  /// Marks a key that is added later as required.
  void require(std::string path) { required_.insert(std::move(path)); }

  Key& operator[](std::size_t index) { return keys_[index]; }
  const std::vector<Key>& keys() const { return keys_; }

  /// Begins and ends the description of the items of a list. Lists that may contain lists of the
  /// same items are described once.
  void open(std::type_index item, std::string path) { open_.emplace_back(item, std::move(path)); }
  void close() { open_.pop_back(); }
  /// The path of the open list with these items; empty if there is none.
  std::string path_of_open(std::type_index item) const;

 private:
  std::vector<Key> keys_;
  std::set<std::string> required_;
  std::vector<std::pair<std::type_index, std::string>> open_;
};

/// Completes the documentation of one key. Without effect when a file is read or written.
class KeyNotes {
 public:
  KeyNotes() = default;
  KeyNotes(KeyCollection& keys, std::size_t index) : keys_(&keys), index_(index) {}

  /// The key's meaning in one sentence, with the unit of its value.
  const KeyNotes& doc(std::string_view unit, std::string_view meaning) const;
  const KeyNotes& doc(std::string_view meaning) const { return set(&Key::meaning, meaning); }

  // Texts instead of those that follow from the description.
  const KeyNotes& type(std::string_view text) const { return set(&Key::type, text); }
  const KeyNotes& range(std::string_view text) const { return set(&Key::range, text); }
  const KeyNotes& fallback(std::string_view text) const { return set(&Key::fallback, text); }

 private:
  const KeyNotes& set(std::string Key::*member, std::string_view text) const;

  KeyCollection* keys_ = nullptr;
  std::size_t index_ = 0;
};

/// A value as YAML on one line, each number by the shortest text that reads back to it. A number
/// that is not finite is "none": such keys are not written.
std::string value_text(const YAML::Node& value);

/// "0 to 10", or "≥ 0" if the upper limit only excludes absurd numbers.
std::string range_text(double low, double high);

/// Reads, writes and documents the keys of a configuration struct. The `describe` function beside
/// the struct names each key once, with its member, its range, its unit and its meaning:
///
///     void describe(Fields& fields, LabelConfig& labels) {
///       fields("share", labels.share, 0.0, 1.0)
///           .doc("A wheel is in contact above this share of the robot's weight.");
///       fields("window", labels.window, 0.0, 1.0)
///           .doc("s", "The normal force is averaged over this time around each step.");
///     }
///
/// The same description reads and writes the struct, in the order of its lines. Reading is strict:
/// every key of the document must be described, with the right type and within its range. Writing
/// works on a copy of the struct. Documenting is like reading a file that has every key and gives
/// no value: `reading()` and `present()` are true, each list has one item, values keep their
/// defaults and checks pass.
class Fields {
 public:
  Fields() = default;  ///< for writing
  /// For reading.
  explicit Fields(const YamlDocument& document) : Fields(document.root(), document, "") {}

  /// For documenting. `keys` must outlive this object.
  explicit Fields(KeyCollection& keys) : Fields(keys, "") {}

  bool reading() const { return reading_; }
  bool documenting() const { return keys_ != nullptr; }
  /// The node that is read, or that has been written so far; empty when documenting.
  const YAML::Node& node() const { return node_; }

  /// Reads or writes one value. When reading, an absent key leaves the value unchanged, and numbers
  /// must be finite and at most 1e15, also where no range follows.
  template <typename T>
  KeyNotes operator()(std::string_view key, T& value) {
    const KeyNotes notes = read_or_write(key, value);
    if constexpr (of_numbers<T>()) {
      if (reading() && has(key)) refuse_absurd_numbers(key, value);
    }
    return notes;
  }

  /// The same with a range: `low <= value <= high`.
  template <typename T>
  KeyNotes operator()(std::string_view key, T& value, std::type_identity_t<T> low,
                      std::type_identity_t<T> high) {
    const KeyNotes notes = read_or_write(key, value);
    const auto least = static_cast<double>(low);
    const auto most = static_cast<double>(high);
    if (documenting()) return notes.range(range_text(least, most));
    if (reading() && has(key) && !(value >= low && value <= high)) {
      fail(key, expected_range(least, most));
    }
    return notes;
  }

  /// The same for a key that must be present.
  void require(std::string_view key);
  template <typename T, typename... Limits>
  KeyNotes require(std::string_view key, T& value, Limits... limits) {
    require(key);
    return (*this)(key, value, limits...);
  }

  /// The same for a value that may be absent: read if the key is present, written if it has one.
  template <typename T, typename... Limits>
  KeyNotes optional(std::string_view key, std::optional<T>& value, Limits... limits) {
    if (!given(key, value.has_value())) return {};
    if (reading()) value.emplace();
    return (*this)(key, *value, limits...).fallback("none");
  }

  /// The same for a value that is written only if it is set.
  template <typename T, typename... Limits>
  KeyNotes if_set(bool is_set, std::string_view key, T& value, Limits... limits) {
    return given(key, is_set) ? (*this)(key, value, limits...) : KeyNotes();
  }

  /// An enumerator or a text, chosen from `names`. An enumerator's value is its index in `names`.
  KeyNotes choose(std::string_view key, const std::vector<std::string>& names, std::string& value);
  KeyNotes choose(std::string_view key, const std::vector<std::string>& names, std::size_t& index);
  template <typename Enum>
  requires std::is_enum_v<Enum> KeyNotes choose(std::string_view key,
                                                const std::vector<std::string>& names,
                                                Enum& value) {
    auto index = static_cast<std::size_t>(value);
    const KeyNotes notes = choose(key, names, index);
    value = static_cast<Enum>(index);
    return notes;
  }

  /// A list of one or more different names, each from `known`.
  KeyNotes names(std::string_view key, const std::vector<std::string>& known,
                 std::vector<std::string>& values);

  /// A list of numbers, written on one line.
  KeyNotes in_line(std::string_view key, std::vector<double>& numbers);

  /// A nested mapping with the fields that `describe_section` names.
  KeyNotes within(std::string_view key, const std::function<void(Fields&)>& describe_section);

  /// A nested struct; its `describe` receives `context`.
  template <typename T, typename... Context>
  KeyNotes section(std::string_view key, T& value, const Context&... context) {
    return within(key, [&](Fields& inner) { describe(inner, value, context...); });
  }

  /// An optional nested struct: read if the key is present, written if it has a value.
  template <typename T, typename... Context>
  KeyNotes section(std::string_view key, std::optional<T>& value, const Context&... context) {
    if (!given(key, value.has_value())) return {};
    if (reading()) value.emplace();
    return section(key, *value, context...).fallback("none");
  }

  /// A nested struct that is written only if it is set.
  template <typename T>
  KeyNotes section_if_set(bool is_set, std::string_view key, T& value) {
    return given(key, is_set) ? section(key, value) : KeyNotes();
  }

  /// A list of structs. The struct that is being read is the last of the list.
  template <typename T, typename... Context>
  KeyNotes list(std::string_view key, std::vector<T>& values, const Context&... context) {
    if (documenting()) {
      Fields defaults;
      defaults.list(key, values, context...);
      return document_list(key, typeid(T), value_text(defaults.node_[std::string(key)]),
                           [&](Fields& item) {
                             values.clear();
                             describe(item, values.emplace_back(), context...);
                           });
    }
    if (present(key, false)) values.clear();
    items(key, values.size(), [&](Fields& item, std::size_t i) {
      if (reading()) values.emplace_back();
      describe(item, values[i], context...);
    });
    return {};
  }

  /// Like `list`, but an empty list is not written.
  template <typename T, typename... Context>
  KeyNotes list_if_any(std::string_view key, std::vector<T>& values, const Context&... context) {
    return reading() || !values.empty() ? list(key, values, context...) : KeyNotes();
  }

  /// Reading: whether the key is present. Writing: `has_value`. Documenting: true.
  bool present(std::string_view key, bool has_value) const;
  /// Declares a key that is read elsewhere or later, so that it is not unknown.
  void know(std::string_view key);
  /// Declares an optional key, so that it is suggested for a misspelt one. The result of `present`.
  bool given(std::string_view key, bool has_value) {
    know(key);
    return present(key, has_value);
  }
  /// Reading: reports a key of former versions, with what replaces it.
  void gone(std::string_view key, const std::string& successor) const {
    if (reading() && has(key)) fail(key, successor);
  }
  /// The number of keys.
  std::size_t size() const;

  /// Reading: reports the first key that has not been described, and suggests the nearest one that
  /// has. Called automatically at the end. Call it earlier, before a check that a misspelt key
  /// would fail, for a clearer message.
  void finish() const { refuse_all_but(known_); }
  /// Reading: reports the first key in this or an inner section that is not among the documented
  /// `keys`, and suggests the nearest one. Call it before a file is read, so that a misspelt key is
  /// not reported as a missing one. Items of lists, and sections without documented keys, pass.
  void refuse_undocumented(const std::vector<Key>& keys) const;

  // Checks are of what is read; documenting skips them.
  /// Reading: reports an error at the key's value unless `holds`.
  void check(bool holds, std::string_view key, const std::string& message) const;
  /// The same at one item of the key's value, if it is a list.
  void check_item(bool holds, std::string_view key, std::size_t item,
                  const std::string& message) const;
  /// Reading: reports an `InputError` of `action` as an error at the key's value.
  void check(std::string_view key, const std::function<void()>& action) const;

 private:
  Fields(YAML::Node node, YamlDocument document, std::string path);
  Fields(KeyCollection& keys, std::string path);

  template <typename T>
  KeyNotes read_or_write(std::string_view key, T& value) {
    if (documenting()) return document(key, kind_name<T>(), value_text(YAML::Node(value)));
    if (!reading()) {
      node_[std::string(key)] = value;
    } else if (const YAML::Node given = take(key)) {
      if constexpr (of_numbers<T>()) refuse_leading_zeros(given, key);
      try {
        value = given.as<T>();
      } catch (const YAML::Exception&) {
        fail(key, fmt::format("expected {}", type_name<T>()));
      }
    }
    return {};
  }

  KeyNotes document(std::string_view key, std::string type, std::string fallback);
  KeyNotes document_list(std::string_view key, std::type_index item_type, std::string fallback,
                         const std::function<void(Fields&)>& describe_item);

  void items(std::string_view key, std::size_t count,
             const std::function<void(Fields&, std::size_t)>& describe_item);

  void refuse_all_but(const std::vector<std::string>& known) const;
  bool has(std::string_view key) const;
  /// Returns the node under `key`, undefined if absent, and marks the key as known.
  YAML::Node take(std::string_view key);
  /// The dotted path from the document's root to `key`.
  std::string path_to(std::string_view key) const;
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  [[noreturn]] void fail(const YAML::Node& node, std::string_view key,
                         const std::string& message) const;

  template <typename T>
  static std::string type_name() {
    if constexpr (std::same_as<T, bool>) {
      return "true or false";
    } else if constexpr (std::integral<T>) {
      return "a whole number";
    } else if constexpr (std::floating_point<T>) {
      return "a number";
    } else if constexpr (std::same_as<T, std::string>) {
      return "a text";
    } else {
      return fmt::format("a list, each item {}", type_name<typename T::value_type>());
    }
  }
  /// The same in the reference of keys, where a list has a plural.
  template <typename T>
  static std::string kind_name() {
    if constexpr (std::same_as<T, bool>) {
      return "true/false";
    } else if constexpr (std::integral<T>) {
      return "whole number";
    } else if constexpr (std::floating_point<T>) {
      return "number";
    } else if constexpr (std::same_as<T, std::string>) {
      return "text";
    } else {
      return fmt::format("list of {}s", kind_name<typename T::value_type>());
    }
  }
  static std::string expected_range(double low, double high);
  template <typename T>
  static constexpr bool of_numbers() {
    if constexpr (requires { typename T::value_type; } && !std::same_as<T, std::string>) {
      return of_numbers<typename T::value_type>();
    } else {
      return std::is_arithmetic_v<T> && !std::same_as<T, bool>;
    }
  }
  /// Rejects leading zeros in quoted numbers. YAML parses these as text, so earlier checks pass
  /// them.
  void refuse_leading_zeros(const YAML::Node& given, std::string_view key) const;

  /// Rejects what no quantity reaches: NaN, infinities and numbers beyond ±1e15.
  template <typename T>
  void refuse_absurd_numbers(std::string_view key, const T& value) const {
    if constexpr (std::floating_point<T>) {
      constexpr double largest = 1e15;
      check(std::abs(static_cast<double>(value)) <= largest, key,
            "expected a finite number, from -1e15 to 1e15");
    } else if constexpr (!std::integral<T>) {
      for (const auto& one : value) refuse_absurd_numbers(key, one);
    }
  }

  bool reading_ = false;
  KeyCollection* keys_ = nullptr;  ///< when documenting
  YAML::Node node_;
  YamlDocument document_;
  std::string path_;
  std::vector<std::string> known_;
};

/// Reads a struct by its description. `config` holds the defaults. Errors: `InputError` with
/// file:line:column.
template <typename T>
T from_yaml(const YamlDocument& document, T config = {}) {
  Fields fields(document);
  describe(fields, config);
  fields.finish();
  return config;
}

/// The struct with all values, defaults included. `from_yaml` reads it back unchanged.
template <typename T>
YAML::Node to_node(T config) {
  Fields fields;
  describe(fields, config);
  return fields.node();
}

/// The keys of a struct, documented by its description. `config` holds the defaults.
template <typename T, typename... Context>
std::vector<Key> documented_keys(T config, const Context&... context) {
  KeyCollection keys;
  Fields fields(keys);
  describe(fields, config, context...);
  return keys.keys();
}

}  // namespace touchdown
