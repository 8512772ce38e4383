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

/// The keys of a configuration struct, which the `describe` beside it names once each, with their
/// members and ranges:
///
///     void describe(Fields& fields, LabelConfig& labels) {
///       fields("force_threshold", labels.force_threshold, 0.0, 1e4);
///       fields("debounce", labels.debounce, 0.0, 10.0);
///     }
///
/// One description reads the struct and writes it, in the order of its lines. It reads strictly:
/// every key that is there must be named, with the right type and within its range. Whatever a
/// description changes while it writes is changed in a copy.
class Fields {
 public:
  Fields() = default;  ///< writes
  explicit Fields(const YamlDocument& document) : Fields(document.root(), document, "") {}

  bool reading() const { return reading_; }
  /// What is read, or has been written.
  const YAML::Node& node() const { return node_; }

  /// Reading: keeps the value where the key is absent.
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

  /// As above; `low <= value <= high`.
  template <typename T>
  void operator()(std::string_view key, T& value, std::type_identity_t<T> low,
                  std::type_identity_t<T> high) {
    (*this)(key, value);
    if (reading() && has(key) && !(value >= low && value <= high)) {
      fail(key, range_text(static_cast<double>(low), static_cast<double>(high)));
    }
  }

  /// A key that must be there.
  void require(std::string_view key);
  template <typename T, typename... Limits>
  void require(std::string_view key, T& value, Limits... limits) {
    require(key);
    (*this)(key, value, limits...);
  }

  /// An enumerator, or a text, by its name. An enumerator's number is its place among the names.
  void choose(std::string_view key, const std::vector<std::string>& names, std::string& value);
  void choose(std::string_view key, const std::vector<std::string>& names, std::size_t& index);
  template <typename Enum>
  requires std::is_enum_v<Enum>
  void choose(std::string_view key, const std::vector<std::string>& names, Enum& value) {
    auto index = static_cast<std::size_t>(value);
    choose(key, names, index);
    value = static_cast<Enum>(index);
  }

  /// At least one name, all different, each one of `known`.
  void names(std::string_view key, const std::vector<std::string>& known,
             std::vector<std::string>& values);

  /// Numbers that are written in one line.
  void in_line(std::string_view key, std::vector<double>& numbers);

  /// A nested mapping, whose fields `describe_section` names.
  void within(std::string_view key, const std::function<void(Fields&)>& describe_section);

  /// A nested struct; `context` is handed on to its `describe`.
  template <typename T, typename... Context>
  void section(std::string_view key, T& value, const Context&... context) {
    within(key, [&](Fields& inner) { describe(inner, value, context...); });
  }

  /// Written, and read, only if it is there.
  template <typename T>
  void section(std::string_view key, std::optional<T>& value) {
    if (!present(key, value.has_value())) return;
    if (reading()) value.emplace();
    section(key, *value);
  }

  /// A list of structs. While one of them is read, it is the list's last.
  template <typename T, typename... Context>
  void list(std::string_view key, std::vector<T>& values, const Context&... context) {
    if (present(key, false)) values.clear();
    items(key, values.size(), [&](Fields& item, std::size_t i) {
      if (reading()) values.emplace_back();
      describe(item, values[i], context...);
    });
  }

  /// As `list`, but an empty one is not written.
  template <typename T, typename... Context>
  void list_if_any(std::string_view key, std::vector<T>& values, const Context&... context) {
    if (reading() || !values.empty()) list(key, values, context...);
  }

  /// Reading: whether the key is there. Writing: `has_value`.
  bool present(std::string_view key, bool has_value) const;
  /// Names a key that may be absent, for the suggestions that a misspelt one gets.
  void know(std::string_view key);
  /// Reading: refuses a key of an earlier version and names the key that replaced it.
  void renamed(std::string_view old_key, std::string_view key) const;
  /// How many keys there are.
  std::size_t size() const;

  /// Reading: complains about the first key that has not been named, and suggests the nearest that
  /// has been. It happens at the end by itself; before a check that a misspelt key would fail, it
  /// gives the better reason.
  void finish() const;

  /// Reading: complains about the key's value unless `holds`.
  void check(bool holds, std::string_view key, const std::string& message) const;
  /// The same at the place of one of the key's values, if it is a list.
  void check_item(bool holds, std::string_view key, std::size_t item,
                  const std::string& message) const;
  /// Reading: an `InputError` of `action` is a complaint about the key's value.
  void check(std::string_view key, const std::function<void()>& action) const;

 private:
  Fields(YAML::Node node, YamlDocument document, std::string path);

  void items(std::string_view key, std::size_t count,
             const std::function<void(Fields&, std::size_t)>& describe_item);

  bool has(std::string_view key) const;
  /// The node under `key`, which is known from now on; undefined if absent.
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
  /// Of a number between quotes, which is a text until somebody reads it as a number.
  void refuse_leading_zeros(const YAML::Node& given, std::string_view key) const;

  bool reading_ = false;
  YAML::Node node_;
  YamlDocument document_;
  std::string path_;
  std::vector<std::string> known_;
};

/// Reads a struct by its description; what `config` holds are the defaults. Errors: `InputError`
/// with file:line:column.
template <typename T>
T from_yaml(const YamlDocument& document, T config = {}) {
  Fields fields(document);
  describe(fields, config);
  fields.finish();
  return config;
}

/// The struct with every default written out, which `from_yaml` reads back to the same.
template <typename T>
YAML::Node to_node(T config) {
  Fields fields;
  describe(fields, config);
  return fields.node();
}

}  // namespace touchdown
