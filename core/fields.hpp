#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "core/yaml.hpp"

namespace touchdown {

/// Reads and writes the keys of a configuration struct. The `describe` function beside the struct
/// names each key once, with its member and its range:
///
///     void describe(Fields& fields, LabelConfig& labels) {
///       fields("force_threshold", labels.force_threshold, 0.0, 1e4);
///       fields("debounce", labels.debounce, 0.0, 10.0);
///     }
///
/// The same description reads and writes the struct, in the order of its lines. Reading is strict:
/// every key of the document must be described, with the right type and within its range. Writing
/// works on a copy of the struct.
class Fields {
 public:
  Fields() = default;  ///< for writing
  /// For reading.
  explicit Fields(const YamlDocument& document) : Fields(document.root(), document, "") {}

  bool reading() const { return reading_; }
  /// The node that is read, or that has been written so far.
  const YAML::Node& node() const { return node_; }

  /// Reads or writes one value. When reading, an absent key leaves the value unchanged.
  template <typename T>
  void operator()(std::string_view key, T& value) {
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
  }

  /// The same with a range: `low <= value <= high`.
  template <typename T>
  void operator()(std::string_view key, T& value, std::type_identity_t<T> low,
                  std::type_identity_t<T> high) {
    (*this)(key, value);
    if (reading() && has(key) && !(value >= low && value <= high)) {
      fail(key, range_text(static_cast<double>(low), static_cast<double>(high)));
    }
  }

  /// The same for a key that must be present.
  void require(std::string_view key);
  template <typename T, typename... Limits>
  void require(std::string_view key, T& value, Limits... limits) {
    require(key);
    (*this)(key, value, limits...);
  }

  /// An enumerator or a text, chosen from `names`. An enumerator's value is its index in `names`.
  void choose(std::string_view key, const std::vector<std::string>& names, std::string& value);
  void choose(std::string_view key, const std::vector<std::string>& names, std::size_t& index);
  template <typename Enum>
  requires std::is_enum_v<Enum>
  void choose(std::string_view key, const std::vector<std::string>& names, Enum& value) {
    auto index = static_cast<std::size_t>(value);
    choose(key, names, index);
    value = static_cast<Enum>(index);
  }

  /// A list of one or more different names, each from `known`.
  void names(std::string_view key, const std::vector<std::string>& known,
             std::vector<std::string>& values);

  /// A list of numbers, written on one line.
  void in_line(std::string_view key, std::vector<double>& numbers);

  /// A nested mapping with the fields that `describe_section` names.
  void within(std::string_view key, const std::function<void(Fields&)>& describe_section);

  /// A nested struct; its `describe` receives `context`.
  template <typename T, typename... Context>
  void section(std::string_view key, T& value, const Context&... context) {
    within(key, [&](Fields& inner) { describe(inner, value, context...); });
  }

  /// An optional nested struct: read if the key is present, written if it has a value.
  template <typename T>
  void section(std::string_view key, std::optional<T>& value) {
    if (!present(key, value.has_value())) return;
    if (reading()) value.emplace();
    section(key, *value);
  }

  /// A list of structs. The struct that is being read is the last of the list.
  template <typename T, typename... Context>
  void list(std::string_view key, std::vector<T>& values, const Context&... context) {
    if (present(key, false)) values.clear();
    items(key, values.size(), [&](Fields& item, std::size_t i) {
      if (reading()) values.emplace_back();
      describe(item, values[i], context...);
    });
  }

  /// Like `list`, but an empty list is not written.
  template <typename T, typename... Context>
  void list_if_any(std::string_view key, std::vector<T>& values, const Context&... context) {
    if (reading() || !values.empty()) list(key, values, context...);
  }

  /// Reading: whether the key is present. Writing: `has_value`.
  bool present(std::string_view key, bool has_value) const;
  /// Declares an optional key, so that it is suggested for a misspelt one.
  void know(std::string_view key);
  /// Reading: rejects a key of an earlier version and names the key that replaced it.
  void renamed(std::string_view old_key, std::string_view key) const;
  /// The number of keys.
  std::size_t size() const;

  /// Reading: reports the first key that has not been described, and suggests the nearest one that
  /// has. Called automatically at the end. Call it earlier, before a check that a misspelt key
  /// would fail, for a clearer message.
  void finish() const;

  /// Reading: reports an error at the key's value unless `holds`.
  void check(bool holds, std::string_view key, const std::string& message) const;
  /// The same at one item of the key's value, if it is a list.
  void check_item(bool holds, std::string_view key, std::size_t item,
                  const std::string& message) const;
  /// Reading: reports an `InputError` of `action` as an error at the key's value.
  void check(std::string_view key, const std::function<void()>& action) const;

 private:
  Fields(YAML::Node node, YamlDocument document, std::string path);

  void items(std::string_view key, std::size_t count,
             const std::function<void(Fields&, std::size_t)>& describe_item);

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
  static std::string range_text(double low, double high);
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

  bool reading_ = false;
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

}  // namespace touchdown
