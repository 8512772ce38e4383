#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/files.hpp"

namespace touchdown::cli {

/// The names in a folder.
inline std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

/// Files of a run directory, hidden ones included, by their paths there, with hashes of their
/// contents. They must not depend on when, where and in how many attempts they were computed. The
/// manifest and the report are left out, because they contain the command line and the time.
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

/// The names of files that are missing or different in one of two run directories.
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
inline std::vector<std::string> different_files(const std::filesystem::path& a,
                                                const std::filesystem::path& b) {
  return different_files(result_files(a), result_files(b));
}

}  // namespace touchdown::cli
