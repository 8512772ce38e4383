#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "core/key.hpp"

namespace touchdown::tests {

/// The documented defaults beside the YAML of a struct with its defaults.
struct ComparedDefaults {
  std::size_t equal = 0;
  std::vector<std::string> different;  ///< paths
};

inline bool are_equal(const YAML::Node& a, const YAML::Node& b) {
  if (a.Type() != b.Type() || a.size() != b.size()) return false;
  if (a.IsScalar()) {
    double x = 0.0;
    double y = 0.0;
    const bool numbers = YAML::convert<double>::decode(a, x) && YAML::convert<double>::decode(b, y);
    return numbers ? x == y : a.Scalar() == b.Scalar();
  }
  for (const auto& entry : a) {
    if (a.IsMap() && !b[entry.first.Scalar()]) return false;
    if (a.IsMap() && !are_equal(entry.second, b[entry.first.Scalar()])) return false;
  }
  for (std::size_t i = 0; a.IsSequence() && i < a.size(); ++i) {
    if (!are_equal(a[i], b[i])) return false;
  }
  return true;
}

/// The value at a dotted path; undefined if there is none.
inline YAML::Node value_at(const YAML::Node& root, const std::string& path) {
  YAML::Node node = YAML::Clone(root);
  std::istringstream words(path);
  for (std::string word; std::getline(words, word, '.');) {
    if (!node.IsMap() || !node[word]) return YAML::Node(YAML::NodeType::Undefined);
    node.reset(node[word]);
  }
  return node;
}

/// Compares every key that `yaml` has. Required keys, sections and items of lists are left out.
inline ComparedDefaults compared_defaults(const std::vector<Key>& keys, const std::string& yaml) {
  const YAML::Node written = YAML::Load(yaml);
  ComparedDefaults result;
  for (const Key& key : keys) {
    const bool has_default = key.fallback != "required" && key.type.find("section") != 0;
    if (!has_default || key.path.find("[]") != std::string::npos) continue;
    const YAML::Node value = value_at(written, key.path);
    if (!value.IsDefined()) continue;
    if (are_equal(YAML::Load(key.fallback), value)) {
      ++result.equal;
    } else {
      result.different.push_back(key.path);
    }
  }
  return result;
}

/// The paths of keys without a meaning.
inline std::vector<std::string> without_meaning(const std::vector<Key>& keys) {
  std::vector<std::string> paths;
  for (const Key& key : keys) {
    if (key.meaning.empty()) paths.push_back(key.path);
  }
  return paths;
}

}  // namespace touchdown::tests
