#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/files.hpp"

namespace touchdown::cli {

/// What stands in a folder.
inline std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

/// Every file of a run directory that must not depend on when, where and in how many attempts it
/// was computed, hidden ones included, by its path there, and what tells its content apart. The
/// manifest and the report say what was typed and when.
inline std::map<std::string, std::size_t> result_files(const std::filesystem::path& directory) {
  std::map<std::string, std::size_t> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    const std::string name = entry.path().lexically_relative(directory).string();
    const bool may_differ =
        name == "manifest.json" || name == "report.html" || name.rfind("state/", 0) == 0;
    if (!entry.is_regular_file() || may_differ) continue;
    files[name] = std::hash<std::string>()(read_file(entry.path()));
  }
  return files;
}

/// The names of those that two run directories do not have in common.
inline std::vector<std::string> different_files(const std::map<std::string, std::size_t>& a,
                                                const std::map<std::string, std::size_t>& b) {
  std::vector<std::string> names;
  for (const auto& [name, content] : a) {
    const auto other = b.find(name);
    if (other == b.end() || other->second != content) names.push_back(name);
  }
  for (const auto& [name, content] : b) {
    if (a.count(name) == 0) names.push_back(name);
  }
  return names;
}

}  // namespace touchdown::cli
