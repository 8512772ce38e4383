#include "recordings/bags/bag_files.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/resources.hpp"

namespace touchdown::recordings {

namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// NAME_10 comes after NAME_9: numbers of more digits are larger.
std::pair<std::size_t, std::string> by_number(const fs::path& file) {
  const std::string name = file.filename().string();
  return {name.size(), name};
}

/// Files that `metadata.yaml` lists. Other keys differ between versions and are not needed. A file
/// that was not written to its end lists none.
std::vector<fs::path> listed_files(const fs::path& metadata) {
  std::vector<fs::path> files;
  try {
    const YAML::Node root = YAML::LoadFile(metadata.string());
    for (const YAML::Node& one : root["rosbag2_bagfile_information"]["relative_file_paths"]) {
      files.emplace_back(one.as<std::string>());
    }
  } catch (const YAML::Exception&) {
    files.clear();
  }
  return files;
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const fs::path& entry : entries_in(folder)) {
    const std::string extension = bag_extension(entry);
    if (fs::is_regular_file(entry, ignored) && (extension == ".mcap" || extension == ".db3")) {
      files.push_back(entry);
    }
  }
  std::sort(files.begin(), files.end(),
            [](const fs::path& a, const fs::path& b) { return by_number(a) < by_number(b); });
  return files;
}

}  // namespace

std::string bag_extension(const fs::path& file) {
  const std::string last = lower(file.extension().string());
  return last == ".zstd" || last == ".zst" ? lower(file.stem().extension().string()) : last;
}

std::vector<fs::path> bag_files(const fs::path& path) {
  if (!is_folder(path)) {
    require_file(path);
    return {path};
  }
  const fs::path metadata = path / "metadata.yaml";
  std::vector<fs::path> files;
  if (is_there(metadata)) files = listed_files(metadata);
  for (fs::path& file : files) {
    const fs::path named = path / file.filename();  // older versions list the folder too
    const fs::path compressed = named.string() + ".zstd";
    file = !is_there(named) && is_there(compressed) ? compressed : named;
    if (!is_there(file)) {
      throw InputError(
          fmt::format("{}: lists {}, which is not there", metadata.string(), named.string()));
    }
  }
  if (files.empty()) files = files_in(path);
  if (files.empty()) {
    throw InputError(
        fmt::format("{}: expected a ROS 2 bag, a folder with .mcap or .db3 files", path.string()));
  }
  return files;
}

}  // namespace touchdown::recordings
