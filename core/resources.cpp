#include "core/resources.hpp"

#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/fingerprint.hpp"
#include "core/yaml.hpp"

namespace touchdown {

namespace {

std::vector<std::filesystem::path> roots() {
  std::error_code ignored;
  const std::filesystem::path own = std::filesystem::weakly_canonical(own_binary(), ignored);
  return {".", TOUCHDOWN_SOURCE_DIR, TOUCHDOWN_SHARE_DIR, own.parent_path() / "share/touchdown"};
}

}  // namespace

std::vector<std::filesystem::path> resources_in(const std::filesystem::path& folder,
                                                const std::string& extension) {
  std::set<std::filesystem::path> files;
  for (const std::filesystem::path& root : roots()) {
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
    for (const std::filesystem::path& root : roots()) {
      if (std::filesystem::is_regular_file(root / path, ignored)) return root / path;
    }
  }
  std::vector<std::string> neighbours;  // named as the request would have to name them
  for (const auto& file : resources_in(path.parent_path(), path.extension().string())) {
    neighbours.push_back(file.string());
  }
  throw InputError(
      fmt::format("{}: no such file{}", path.string(), did_you_mean(path.string(), neighbours)));
}

}  // namespace touchdown
