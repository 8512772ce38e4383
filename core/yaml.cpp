#include "core/yaml.hpp"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/yaml_text.hpp"

namespace touchdown {

namespace {

/// Rejects duplicate keys: yaml-cpp silently keeps the first and ignores the second.
void refuse_duplicate_keys(const YAML::Node& node, const std::string& name) {
  if (node.IsSequence()) {
    for (const auto& item : node) refuse_duplicate_keys(item, name);
  }
  if (!node.IsMap()) return;
  std::set<std::string> seen;
  for (const auto& entry : node) {
    if (entry.first.IsScalar() && !seen.insert(entry.first.Scalar()).second) {
      const YAML::Mark mark = entry.first.Mark();
      throw InputError(fmt::format("{}:{}:{}: {}: appears twice", name, mark.line + 1,
                                   mark.column + 1, entry.first.Scalar()));
    }
    refuse_duplicate_keys(entry.second, name);
  }
}

YAML::Node parse_or_complain(const std::string& text, const std::string& name) {
  const auto place = [&](const YAML::Mark& mark) {
    return fmt::format("{}:{}:{}", name, mark.line + 1, mark.column + 1);
  };
  try {
    check_yaml_text(text, place);
    YAML::Node root = YAML::Load(text);
    if (!root.IsMap()) {
      throw InputError(fmt::format("{}:1:1: expected a mapping of keys to values", name));
    }
    refuse_duplicate_keys(root, name);
    return root;
  } catch (const YAML::ParserException& error) {
    throw InputError(fmt::format("{}: not valid YAML: {}", place(error.mark), error.msg));
  }
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitution});
    }
  }
  return row[b.size()];
}

/// Returns the node at `key` below `parent`. List items are addressed by number.
YAML::Node descend(YAML::Node parent, const std::string& key, std::string_view assignment) {
  if (!parent.IsSequence()) return parent[key];
  std::size_t item = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), item);
  if (error != std::errc{} || end != key.data() + key.size() || item >= parent.size()) {
    throw InputError(fmt::format("--set {}: '{}' is not the number of an item (0 to {})",
                                 assignment, key, parent.size() - 1));
  }
  return parent[item];
}

}  // namespace

YamlDocument YamlDocument::load(const std::filesystem::path& path) {
  return parse(read_file(path), path.string());
}

YamlDocument YamlDocument::parse(const std::string& text, const std::string& name) {
  YamlDocument document;
  document.name_ = name;
  document.root_ = parse_or_complain(text, name);
  return document;
}

void YamlDocument::override_value(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw InputError(fmt::format("--set {}: expected key=value", assignment));
  }
  YAML::Node value;
  try {
    const std::string text(assignment.substr(equals + 1));
    check_yaml_text(text, [&](const YAML::Mark&) { return fmt::format("--set {}", assignment); });
    value = YAML::Load(text);
  } catch (const YAML::ParserException& error) {
    throw InputError(fmt::format("--set {}: not a YAML value: {}", assignment, error.msg));
  }
  std::vector<std::string> keys;
  std::stringstream dotted{std::string(assignment.substr(0, equals)) + "."};
  for (std::string key; std::getline(dotted, key, '.');) {
    if (key.empty()) {
      throw InputError(fmt::format("--set {}: expected names between the dots", assignment));
    }
    keys.push_back(key);
  }

  YAML::Node parent = root_;
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    parent.reset(descend(parent, keys[i], assignment));
    if (parent.IsScalar()) {
      throw InputError(fmt::format("--set {}: '{}' holds no keys", assignment, keys[i]));
    }
  }
  if (parent.IsSequence()) {
    descend(parent, keys.back(), assignment) = value;
  } else {
    parent[keys.back()] = value;
  }
  overrides_.push_back({std::string(assignment.substr(0, equals)), std::string(assignment)});
}

std::string YamlDocument::place_of(const YAML::Node& node, std::string_view key) const {
  for (auto last = overrides_.rbegin(); last != overrides_.rend(); ++last) {
    const bool within = key.starts_with(last->key) &&
                        (key.size() == last->key.size() || key[last->key.size()] == '.');
    if (within) return "--set " + last->assignment;
  }
  const YAML::Mark mark = node ? node.Mark() : YAML::Mark::null_mark();
  return mark.is_null() ? name_ : fmt::format("{}:{}:{}", name_, mark.line + 1, mark.column + 1);
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t longer = std::max(word.size(), candidate.size());
    if (longer - std::min(word.size(), candidate.size()) >= best_distance) continue;
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string near = nearest(word, candidates);
  return near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near);
}

}  // namespace touchdown
