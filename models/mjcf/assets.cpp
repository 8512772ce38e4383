#include "models/mjcf/assets.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <sstream>
#include <system_error>

#include <fmt/format.h>

#include "core/files.hpp"
#include "models/mjcf/robot_file.hpp"

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

/// The compiler attributes of an MJCF, or of MuJoCo's section of a URDF; the last ones count.
using Compiler = std::map<std::string, std::string>;

Compiler compiler_of(const MjcfDocument& document) {
  Compiler compiler;
  document.visit([&](const XMLElement& e) {
    if (std::string_view(e.Name()) != "compiler") return;
    for (const auto* a = e.FirstAttribute(); a != nullptr; a = a->Next()) {
      compiler[a->Name()] = a->Value();
    }
  });
  return compiler;
}

/// The file of an asset, as MuJoCo searches it.
std::filesystem::path file_of(const MjcfDocument& document, Compiler& compiler,
                              const XMLElement& asset, const char* folder) {
  std::filesystem::path file(std::string(attribute(asset, "file")));
  if (compiler["strippath"] == "true") file = file.filename();
  const std::string& own = compiler[folder].empty() ? compiler["assetdir"] : compiler[folder];
  return (document.file().parent_path() / own / file).lexically_normal();
}

bool is_missing(const std::filesystem::path& file) {
  std::error_code ignored;
  return !std::filesystem::is_regular_file(file, ignored);
}

/// The name of an asset: its own, or its file's.
std::string name_of(const XMLElement& asset) {
  const std::string name(attribute(asset, "name"));
  return name.empty() ? std::filesystem::path(std::string(attribute(asset, "file"))).stem().string()
                      : name;
}

/// Whether a body's mass and inertia do not depend on one of its geoms.
bool has_own_mass(const MjcfDocument& document, const XMLElement& geom) {
  const XMLElement& body = *geom.Parent()->ToElement();
  if (body.FirstChildElement("inertial") != nullptr) return true;
  return numbers(attribute_or_default(document, geom, "mass")) == std::vector<double>{0.0};
}

/// Removes a mesh or a texture without its file, with the geoms of this mesh.
void drop(RobotFile& robot, XMLElement& asset, const std::string& file) {
  MjcfDocument& document = robot.document;
  const std::string tag = asset.Name();
  const std::string name = name_of(asset);
  const std::string about = fmt::format("{} '{}': {}: no such file", tag, name, file);
  std::vector<XMLElement*> users;
  document.visit([&](XMLElement& e) {
    const bool is_user = std::string_view(e.Name()) == (tag == "mesh" ? "geom" : "material");
    if (is_user && attribute_or_default(document, e, tag.c_str()) == name) users.push_back(&e);
  });
  std::string untouched;
  for (XMLElement* const user : users) {
    const XMLElement& parent = *user->Parent()->ToElement();
    if (tag == "texture") document.replace(*user, "texture");
    if (tag == "texture" || std::string_view(parent.Name()) == "default") continue;
    if (!has_own_mass(document, *user)) {
      document.fail(asset, fmt::format("{}, and {} has its mass from it: expected an <inertial>",
                                       about, title_of(parent)));
    }
    if (!is_visual(document, *user))
      untouched = ", and " + title_of(parent) + " does not touch with it";
    document.remove(*user);
  }
  robot.ignore(asset, about + ": not drawn" + untouched);
  document.remove(asset);
}

/// Vertices, texture points and normals of an OBJ.
using ObjCounts = std::array<std::int64_t, 3>;

void count_line(std::string_view word, ObjCounts& counts) {
  constexpr std::array<std::string_view, 3> words = {"v", "vt", "vn"};
  for (std::size_t i = 0; i < words.size(); ++i) counts[i] += word == words[i] ? 1 : 0;
}

/// Whether a corner of a face, "vertex/texture/normal" of which all but the first may be missing,
/// is there. A number below zero counts backwards from the last one so far; others may name a later
/// one.
bool is_corner(std::string_view corner, const ObjCounts& so_far, const ObjCounts& all) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string_view digits = corner.substr(0, corner.find('/'));
    std::int64_t number = 0;
    const char* const end = digits.data() + digits.size();
    const auto [read, wrong] = std::from_chars(digits.data(), end, number);
    const bool is_there = wrong == std::errc() && read == end && number != 0 &&
                          number >= -so_far[i] && number <= all[i];
    if (!digits.empty() && !is_there) return false;
    corner.remove_prefix(std::min(corner.size(), digits.size() + 1));
  }
  return true;
}

}  // namespace

std::string fault_of_mesh(const std::filesystem::path& file) {
  if (extension_of(file) != ".obj") return "";
  const std::string text = read_file(file);
  ObjCounts all = {};
  std::string line;
  std::string word;
  for (std::istringstream lines(text); std::getline(lines, line);) {
    if (std::istringstream(line) >> word) count_line(word, all);
  }
  ObjCounts so_far = {};
  std::istringstream lines(text);
  for (std::size_t row = 1; std::getline(lines, line); ++row) {
    std::istringstream words(line);
    if (!(words >> word)) continue;
    count_line(word, so_far);
    if (word != "f") continue;
    while (words >> word) {
      if (is_corner(word, so_far, all)) continue;
      return fmt::format("{}:{}: a face with a corner '{}', which is not there", file.string(), row,
                         word);
    }
  }
  return "";
}

std::string mesh_folder(const MjcfDocument& document) { return compiler_of(document)["meshdir"]; }

std::filesystem::path urdf_asset(std::string_view address, const std::filesystem::path& urdf,
                                 const std::string& meshdir) {
  constexpr std::string_view plain = "file://";
  std::vector<std::filesystem::path> candidates;
  const std::filesystem::path folder = absolute_path(urdf).parent_path();
  if (address.starts_with(package_address)) {
    const std::filesystem::path path(address.substr(package_address.size()));
    const std::filesystem::path inside = path.lexically_relative(*path.begin());
    for (std::filesystem::path above = folder;; above = above.parent_path()) {
      candidates.insert(candidates.end(), {above / path, above / inside});
      if (above == above.parent_path()) break;
    }
  } else {
    candidates.push_back(folder /
                         (address.starts_with(plain) ? address.substr(plain.size()) : address));
  }
  for (const auto& beside : {folder / meshdir, folder}) {
    candidates.push_back(beside / std::filesystem::path(address).filename());
  }
  const auto file = std::find_if_not(candidates.begin(), candidates.end(), is_missing);
  return file == candidates.end() ? std::filesystem::path() : file->lexically_normal();
}

std::vector<std::filesystem::path> opened_files(const std::filesystem::path& file) {
  const MjcfDocument document = MjcfDocument::load(file);
  std::vector<std::filesystem::path> files = document.files();
  Compiler compiler = compiler_of(document);
  document.visit([&](const XMLElement& element) {
    std::vector<std::filesystem::path> candidates;
    if (element.Attribute("filename") != nullptr) {
      candidates = {
          urdf_asset(attribute(element, "filename"), document.file(), compiler["meshdir"])};
    } else if (element.Attribute("file") != nullptr) {
      candidates = {file_of(document, compiler, element, "meshdir"),
                    file_of(document, compiler, element, "texturedir")};
    }
    for (const std::filesystem::path& candidate : candidates) {
      const bool is_listed = std::find(files.begin(), files.end(), candidate) != files.end();
      if (!is_listed && !is_missing(candidate)) files.push_back(candidate);
    }
  });
  return files;
}

namespace {

/// Draws a body without a shape as rods from its frame to those of its children.
void draw_as_rods(MjcfDocument& document, XMLElement& body) {
  const std::vector<XMLElement*> below = children(body, "body");
  const bool has_shape = body.FirstChildElement("geom") != nullptr;
  for (XMLElement* const child : below) {
    draw_as_rods(document, *child);
    const std::string_view end = attribute(*child, "pos");
    const std::vector<double> at = numbers(end);
    constexpr double shortest = 1e-3;  // m
    if (has_shape || at.size() != 3 || std::hypot(at[0], at[1], at[2]) < shortest) continue;
    document.insert_before(
        *below.front(),
        fmt::format("<geom type=\"capsule\" size=\".012\" fromto=\"0 0 0 {}\" mass=\"0\" "
                    "contype=\"0\" conaffinity=\"0\" group=\"0\"/>",
                    end));
  }
}

}  // namespace

void drop_missing_assets(RobotFile& robot) {
  MjcfDocument& document = robot.document;
  Compiler compiler = compiler_of(document);
  for (XMLElement* const asset : in_sections(document.root(), "asset")) {
    const std::string_view tag = asset->Name();
    const bool is_mesh = tag == "mesh";
    if ((!is_mesh && tag != "texture") || asset->Attribute("file") == nullptr) continue;
    const std::filesystem::path file =
        file_of(document, compiler, *asset, is_mesh ? "meshdir" : "texturedir");
    const std::string fault = is_mesh && !is_missing(file) ? fault_of_mesh(file) : "";
    if (!fault.empty()) {
      document.fail(*asset, fmt::format("mesh '{}': {}", name_of(*asset), fault));
    }
    if (!is_missing(file)) continue;
    drop(robot, *asset, file.string());
  }
  for (XMLElement* const body : in_sections(document.root(), "worldbody", "body")) {
    draw_as_rods(document, *body);
  }
}

}  // namespace touchdown::models
