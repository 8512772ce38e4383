#pragma once

#include <concepts>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "core/error.hpp"

namespace touchdown {

/// A YAML document with the name of the file it came from, so that every complaint can say
/// `file:line:column`. Overrides (`--set a.b=c`) are applied before anything is read.
class YamlDocument {
 public:
  /// Errors: `InputError` when the file is missing or is not YAML.
  static YamlDocument load(const std::filesystem::path& path);
  static YamlDocument parse(const std::string& text, const std::string& name);

  /// Replace the value at a dotted key (list items by number), for example `noise.seeds=3`.
  /// Only keys that the document has, or could have, are caught later, by whoever reads them.
  void override_value(std::string_view assignment);

  const YAML::Node& root() const { return root_; }
  const std::string& name() const { return name_; }

 private:
  YAML::Node root_;
  std::string name_;
};

/// Reads one mapping strictly: every key that is present must be asked for, with the right type and
/// within its range; `finish()` complains about the rest and suggests the nearest known key.
///
///     YamlMap map(document);
///     map.read("duration", config.duration, at_least(0.0));
///     map.finish();
class YamlMap {
 public:
  explicit YamlMap(const YamlDocument& document);
  YamlMap(YAML::Node node, std::string file, std::string path);

  bool has(std::string_view key) const;

  /// Overwrites `value` if the key is present; otherwise leaves the default.
  template <typename T>
  void read(std::string_view key, T& value) {
    if (const YAML::Node node = take(key)) value = convert<T>(node, key);
  }

  /// As above, and the value must satisfy `low <= value <= high`.
  template <typename T>
  void read(std::string_view key, T& value, std::type_identity_t<T> low,
            std::type_identity_t<T> high) {
    const YAML::Node node = take(key);
    if (!node) return;
    const T read_value = convert<T>(node, key);
    if (!(read_value >= low && read_value <= high)) {
      fail(node, key,
           "expected " + range_text(static_cast<double>(low), static_cast<double>(high)));
    }
    value = read_value;
  }

  /// As `read`, but the key must be there.
  template <typename T>
  void require(std::string_view key, T& value) {
    if (!has(key)) fail(node_, key, "is missing");
    read(key, value);
  }

  /// A value that must be one of `names`; returns its index, or `otherwise` when absent.
  std::size_t choose(std::string_view key, const std::vector<std::string>& names,
                     std::size_t otherwise);

  /// A nested mapping; an empty one if absent.
  YamlMap child(std::string_view key);
  /// A list of mappings; empty if absent.
  std::vector<YamlMap> children(std::string_view key);
  /// The raw node under `key`, marked as known; undefined if absent.
  YAML::Node take(std::string_view key);

  /// Errors: `InputError` for the first key nobody asked for.
  void finish() const;

  /// Throws an `InputError` that points at this mapping's `key`.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;

  const std::string& file() const { return file_; }
  const YAML::Node& node() const { return node_; }

 private:
  template <typename T>
  T convert(const YAML::Node& node, std::string_view key) const {
    try {
      return node.as<T>();
    } catch (const YAML::Exception&) {
      fail(node, key, "expected " + type_name<T>());
    }
  }

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
      return "a list, each item " + type_name<typename T::value_type>();
    }
  }

  static std::string range_text(double low, double high);
  [[noreturn]] void fail(const YAML::Node& node, std::string_view key,
                         const std::string& message) const;

  YAML::Node node_;
  std::string file_;
  std::string path_;
  std::vector<std::string> known_;
};

/// The entry of `candidates` that is fewest edits away from `word`, or empty if none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// " (did you mean 'nearest'?)", or nothing if none is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace touchdown
