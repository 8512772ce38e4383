// Every YAML file of the project, with every value replaced by others of the wrong type. A reader
// refuses them with a message of its own: one line that begins with the file's name.

#include <algorithm>
#include <filesystem>
#include <functional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "core/error.hpp"
#include "core/fields.hpp"
#include "core/files.hpp"
#include "experiments/config/experiment_yaml.hpp"
#include "logs/mapping/conversion.hpp"
#include "models/robot_description.hpp"
#include "noise/sensor_profile.hpp"
#include "scenarios/scenario.hpp"
#include "tests/fuzz/entry.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::fuzz {
namespace {

namespace fs = std::filesystem;

using Reader = std::function<void(const std::string& text)>;

/// The keys and numbers of items from the root to each value.
void add_paths(const YAML::Node& node, std::vector<YAML::Node>& path,
               std::vector<std::vector<YAML::Node>>& paths) {
  paths.push_back(path);
  const auto descend = [&](const YAML::Node& key, const YAML::Node& value) {
    path.push_back(key);
    add_paths(value, path, paths);
    path.pop_back();
  };
  if (node.IsMap()) {
    for (const auto& entry : node) descend(entry.first, entry.second);
  } else if (node.IsSequence()) {
    for (std::size_t i = 0; i < std::min<std::size_t>(node.size(), 2); ++i) {
      descend(YAML::Node(i), node[i]);
    }
  }
}

/// The document with another value at a path.
std::string damaged(const std::string& text, const std::vector<YAML::Node>& path,
                    const std::string& value) {
  YAML::Node root = YAML::Load(text);
  if (path.empty()) return value;
  YAML::Node node;
  node.reset(root);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    node.reset(node.IsSequence() ? node[path[i].as<std::size_t>()]
                                 : node[path[i].as<std::string>()]);
  }
  if (node.IsSequence()) {
    node[path.back().as<std::size_t>()] = YAML::Load(value);
  } else {
    node[path.back().as<std::string>()] = YAML::Load(value);
  }
  return YAML::Dump(root);
}

/// Reads a damaged text, and judges the message.
void read(const Reader& reader, const std::string& text) {
  try {
    reader(text);
  } catch (const Error& error) {
    const std::string_view message = error.what();
    EXPECT_FALSE(is_of_a_library(message)) << message << '\n' << text;
    EXPECT_EQ(message.find('\n'), std::string_view::npos) << message;
    EXPECT_NE(message.find("damaged.yaml"), std::string_view::npos) << message << '\n' << text;
  } catch (const std::exception& error) {
    ADD_FAILURE() << "not an Error: " << error.what() << '\n' << text;
  }
}

/// The path as one word, without the numbers of items.
std::string name_of(const std::vector<YAML::Node>& path) {
  std::string name;
  for (const YAML::Node& key : path) {
    const std::string text = YAML::Dump(key);
    if (text.find_first_not_of("0123456789") != std::string::npos) name += "/" + text;
  }
  return name;
}

/// `tried`: names of paths in files of the same kind. A further path of such a name gets one value
/// instead of three.
void read_damaged(const std::string& text, const Reader& reader, std::set<std::string>& tried) {
  constexpr std::string_view values[] = {
      "~",        "[]",          "{}",     "text",   "-1",         "1e300",
      "[[1]]",    "{a: 1}",      "true",   "''",     ".nan",       "123456789012345678901",
      "{[a]: 1}", "{{a: 1}: 1}", "[~, ~]", "{~: 1}", "!!binary x", "0x10"};
  std::vector<YAML::Node> path;
  std::vector<std::vector<YAML::Node>> paths;
  add_paths(YAML::Load(text), path, paths);
  std::size_t next = text.size();
  for (const std::vector<YAML::Node>& at : paths) {
    const int count = tried.insert(name_of(at)).second ? 3 : 1;
    for (int k = 0; k < count; ++k) {  // every value at many paths, not at each
      read(reader, damaged(text, at, std::string(values[next++ % std::size(values)])));
    }
  }
  for (const std::size_t length : {std::size_t{0}, text.size() / 3, text.size() / 2}) {
    read(reader, text.substr(0, length));
  }
  for (const std::string_view more :
       {"? [a, b]\n: 1\n", "? {a: 1}\n: 2\n", "~: 1\n", "<<: 3\n", "1: 1\n", "\xff: 1\n", "\"\\x",
        "a: *b\n", "&a [*a]\n", "!!map 3\n", "- 1\n", "\t\n"}) {
    read(reader, text + "\n" + std::string(more));
  }
}

void read_damaged_files(const std::string& folder, const Reader& reader) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(TOUCHDOWN_SOURCE_DIR) / folder)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  ASSERT_GE(files.size(), 3U) << folder;
  std::sort(files.begin(), files.end());
  std::set<std::string> tried;
  for (const fs::path& file : files) {
    SCOPED_TRACE(file.string());
    read_damaged(read_file(file), reader, tried);
  }
}

YamlDocument document(const std::string& text) { return YamlDocument::parse(text, "damaged.yaml"); }

TEST(DamagedYaml, OfExperimentsIsRefusedInOwnWords) {
  read_damaged_files("experiments", [](const std::string& text) {
    (void)experiments::experiment_from_yaml(document(text));
  });
}

TEST(DamagedYaml, OfScenariosIsRefusedInOwnWords) {
  read_damaged_files("scenarios", [](const std::string& text) {
    (void)scenarios::scenario_from_yaml(document(text));
  });
}

TEST(DamagedYaml, OfRobotsIsRefusedInOwnWords) {
  read_damaged_files("models", [](const std::string& text) {
    (void)from_yaml<models::RobotDescription>(document(text));
  });
}

TEST(DamagedYaml, OfSensorsIsRefusedInOwnWords) {
  read_damaged_files("noise/profiles", [](const std::string& text) {
    (void)from_yaml<noise::SensorProfile>(document(text));
  });
}

TEST(DamagedYaml, OfMappingsIsRefusedInOwnWords) {
  const ScratchFolder folder;
  const fs::path log = folder.write("log.csv", "t,a,b\n0,1,2\n0.001,1,2\n");
  std::set<std::string> tried;
  read_damaged(R"(time: {column: t, unit: ms}
acceleration: {columns: [a, b, a], unit: g}
angular_velocity: {columns: [a, b, a]}
orientation: {columns: [a, b, a, b], order: xyzw}
joints:
  names: [lh, lk, lw, rh, rk, rw]
  position: {columns: [a, b, a, a, b, a], unit: deg}
  velocity: {columns: [a, b, a, a, b, a]}
  torque: {columns: [a, b, a, a, b, a]}
  sign: [1, 1, 1, -1, -1, -1]
)",
               [&](const std::string& text) {
                 std::ostringstream stream;
                 (void)logs::convert_log(log, folder.write("damaged.yaml", text), stream,
                                         {.with_labels = true});
               },
               tried);
}

}  // namespace
}  // namespace touchdown::fuzz
