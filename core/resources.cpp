#include "core/resources.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/fingerprint.hpp"

namespace touchdown {

namespace {

bool has_program_files(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(folder / "models/upkie.xml", ignored);
}

std::vector<std::filesystem::path> roots() {
  const std::filesystem::path own = program_files().folder;
  return own.empty() ? std::vector<std::filesystem::path>{"."}
                     : std::vector<std::filesystem::path>{".", own};
}

/// The names of the files in the same folder with the same extension.
std::vector<std::string> neighbours_of(const std::filesystem::path& path) {
  std::vector<std::string> names;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  try {
    for (const std::filesystem::path& entry : entries_in(folder)) {
      if (entry.extension() == path.extension()) names.push_back(entry.filename().string());
    }
  } catch (const Error&) {
    // They are suggestions: without them the message is that the file is missing.
  }
  return names;
}

/// A suggestion where the folder of a path has no such file, because the folder was renamed: the
/// program's own file of the same name.
std::string same_name_elsewhere(const std::filesystem::path& path) {
  const std::vector<std::filesystem::path> places = roots();
  for (const char* folder : {"experiments", "models", "noise/profiles", "scenarios"}) {
    const std::filesystem::path candidate = folder / path.filename();
    std::error_code ignored;
    for (const std::filesystem::path& root : places) {
      if (!std::filesystem::is_regular_file(root / candidate, ignored)) continue;
      return fmt::format(" (did you mean '{}'?)", candidate.string());
    }
  }
  return "";
}

/// Errors: `InputError` for what is there, but cannot be a file: a folder, a pipe, a device, a loop
/// of links, a name that is too long.
void require_missing(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::status(path, ignored).type() != std::filesystem::file_type::not_found) {
    require_regular_file(path);
  }
}

}  // namespace

ProgramFiles program_files() {
  const std::filesystem::path installed = "share/touchdown";
  std::error_code ignored;
  std::filesystem::path folder =
      std::filesystem::weakly_canonical(own_binary(), ignored).parent_path();
  for (; !folder.empty(); folder = folder.parent_path()) {
    for (const std::filesystem::path& place : {folder, folder / installed}) {
      if (has_program_files(place)) return {place, "beside the program"};
    }
    if (folder == folder.root_path()) break;
  }
  if (const char* const named = std::getenv("TOUCHDOWN"); named != nullptr && *named != '\0') {
    if (has_program_files(named)) return {named, "named by TOUCHDOWN"};
    throw InputError(
        fmt::format("TOUCHDOWN={}: has no models/upkie.xml: expected a checkout or a folder "
                    "share/touchdown",
                    named));
  }
  if (has_program_files(TOUCHDOWN_SHARE_DIR)) return {TOUCHDOWN_SHARE_DIR, "installed"};
  if (has_program_files(TOUCHDOWN_SOURCE_DIR)) {
    return {TOUCHDOWN_SOURCE_DIR, "from which the program was built"};
  }
  return {};
}

std::vector<std::filesystem::path> resources_in(const std::filesystem::path& folder,
                                                const std::string& extension) {
  std::set<std::filesystem::path> files;
  for (const std::filesystem::path& root : roots()) {
    std::error_code ignored;
    for (const std::filesystem::path& entry : entries_in(root / folder)) {
      if (std::filesystem::is_regular_file(entry, ignored) && entry.extension() == extension) {
        files.insert(folder / entry.filename());
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
  require_missing(path);
  std::vector<std::string> neighbours;  // as a request would name them
  for (const std::string& extension : {path.extension().string(), std::string(".yaml")}) {
    for (const auto& file : resources_in(path.parent_path(), extension)) {
      neighbours.push_back(file.string());
    }
  }
  std::string near = did_you_mean(path.string(), neighbours);
  if (near.empty()) near = same_name_elsewhere(path);
  throw InputError(fmt::format("{}: no such file{}", path.string(), near));
}

std::filesystem::path find_program_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::path folder = program_files().folder;
  const std::filesystem::path own = folder / path;
  if (folder.empty() || !std::filesystem::is_regular_file(own, ignored)) return find_resource(path);
  // In the program's own folder the short name stays.
  return std::filesystem::equivalent(own, path, ignored) ? path : own;
}

void require_file(const std::filesystem::path& path) {
  std::error_code ignored;
  require_missing(path);
  if (std::filesystem::is_regular_file(path, ignored)) return;
  throw InputError(fmt::format("{}: no such file{}", path.string(),
                               did_you_mean(path.filename().string(), neighbours_of(path))));
}

namespace {

/// Checks the names at the end of a dotted key below `node`, in all items of a list.
void require_below(const YamlDocument& document, const YAML::Node& node, const std::string& key,
                   std::string_view rest, const std::function<void(const std::string&)>& require) {
  if (node.IsSequence()) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      require_below(document, node[i], fmt::format("{}.{}", key, i), rest, require);
    }
  } else if (rest.empty() && node.IsScalar()) {
    try {
      require(node.Scalar());
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}: {}", document.place_of(node, key), key, error.what()));
    }
  } else if (!rest.empty() && node.IsMap()) {
    const std::size_t dot = std::min(rest.find('.'), rest.size());
    const std::string name(rest.substr(0, dot));
    const YAML::Node below = node[name];
    if (!below) return;
    require_below(document, below, key.empty() ? name : fmt::format("{}.{}", key, name),
                  rest.substr(std::min(dot + 1, rest.size())), require);
  }
}

}  // namespace

/// `open`: the files that are being completed.
static YamlDocument with_base(YamlDocument document, std::vector<std::filesystem::path> open) {
  YAML::Node root = document.root();
  const YAML::Node base = root["base"];
  if (!base.IsDefined()) return document;
  try {
    if (!base.IsScalar()) throw InputError("expected a file");
    open.push_back(find_resource(base.Scalar()));
    const auto same = [&](const auto& file) {
      return std::filesystem::equivalent(file, open.back());
    };
    if (std::any_of(open.begin(), open.end() - 1, same)) {
      throw InputError(fmt::format("'{}' is based on itself", base.Scalar()));
    }
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: base: {}", document.place_of(base, "base"), error.what()));
  }
  root.remove("base");
  document.put_on(with_base(YamlDocument::load(open.back()), open));
  return document;
}

YamlDocument with_base(YamlDocument document) { return with_base(std::move(document), {}); }

void require_resources(const YamlDocument& document, const std::vector<std::string>& keys,
                       const std::function<void(const std::string&)>& require) {
  for (const std::string& key : keys) require_below(document, document.root(), "", key, require);
}

}  // namespace touchdown
