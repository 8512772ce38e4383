#include "core/resources.hpp"

#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/yaml.hpp"

namespace touchdown {

namespace {

const std::vector<std::filesystem::path>& roots() {
  static const std::vector<std::filesystem::path> places = {".", TOUCHDOWN_SOURCE_DIR,
                                                            TOUCHDOWN_SHARE_DIR};
  return places;
}

/// Files that stand where `path` was looked for, named as the request would have to name them.
std::vector<std::string> neighbours(const std::filesystem::path& path) {
  std::vector<std::string> names;
  for (const auto& file : resources_in(path.parent_path(), path.extension().string())) {
    names.push_back(file.string());
  }
  return names;
}

}  // namespace

std::vector<std::filesystem::path> resources_in(const std::filesystem::path& folder,
                                                const std::string& extension) {
  std::set<std::filesystem::path> files;
  for (const auto& root : roots()) {
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(root / folder, ignored)) {
      if (entry.is_regular_file(ignored) && entry.path().extension() == extension) {
        files.insert(folder / entry.path().filename());
      }
    }
  }
  return {files.begin(), files.end()};
}

std::filesystem::path find_resource(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) return path;
  if (path.is_relative()) {
    for (const auto& root : roots()) {
      if (std::filesystem::is_regular_file(root / path, ignored)) return root / path;
    }
  }
  throw InputError(fmt::format("{}: no such file{}", path.string(),
                               did_you_mean(path.string(), neighbours(path))));
}

}  // namespace touchdown
