#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "core/error.hpp"
#include "core/nearest.hpp"

namespace touchdown {

/// Whether a text is a whole number with a leading zero, which some parsers read as octal.
bool has_leading_zero(std::string_view number);

/// A YAML document with the name of its file, so that every error names `file:line:column`.
/// Overrides (`--set a.b=c`) are applied before any value is read.
class YamlDocument {
 public:
  /// Errors: `InputError` when the file is missing or is not YAML.
  static YamlDocument load(const std::filesystem::path& path);
  static YamlDocument parse(const std::string& text, const std::string& name);

  /// Replaces the value at a dotted key (list items by number), for example `noise.seeds=3`.
  /// Does not check whether the key is valid: the code that reads the document does. Errors:
  /// `InputError` for an assignment that is none, or replaces an earlier one.
  void override_value(std::string_view assignment);

  /// Adds what `base` has and this document has not. Mappings are merged key by key; of lists and
  /// scalars this document's own stay. A key without a value (`~`) removes the key of the base.
  void put_on(const YamlDocument& base);

  const YAML::Node& root() const { return root_; }
  const std::string& name() const { return name_; }

  /// The origin of the value under a dotted key: `file:line:column`, also in a base, or the
  /// assignment that set it.
  std::string place_of(const YAML::Node& node, std::string_view key) const;

 private:
  /// Where the value under a key comes from, with all that is nested in it and has no later origin.
  struct Origin {
    std::string key;     ///< dotted; empty: the whole document
    std::string source;  ///< the file, or the assignment
    bool is_assignment = false;
    YAML::Mark mark;  ///< of merged mappings, which have none of their own
  };

  const Origin& origin_of(std::string_view key) const;
  YAML::Node merged(const YAML::Node& own, const YAML::Node& base, const std::string& key,
                    const YamlDocument& of_base);

  YAML::Node root_;
  std::string name_;
  std::vector<Origin> origins_ = {{}};
};

/// Empty for one of the `candidates`; else "'bulet': expected mujoco or bullet (did you mean ...)".
std::string not_one_of(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace touchdown
