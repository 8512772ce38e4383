#include <system_error>

#include <fmt/format.h>

#include "models/mjcf/document.hpp"
#include "models/mjcf/robot_file.hpp"

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

/// A compiler attribute; the last one counts.
std::string compiler_attribute(const MjcfDocument& document, const char* name) {
  std::string value;
  for (auto* e : children(document.root(), "compiler")) {
    if (e->Attribute(name) != nullptr) value = attribute(*e, name);
  }
  return value;
}

/// The file of an asset, as MuJoCo searches it.
std::filesystem::path file_of(const MjcfDocument& document, const XMLElement& asset,
                              const char* folder) {
  std::filesystem::path file(std::string(attribute(asset, "file")));
  if (compiler_attribute(document, "strippath") == "true") file = file.filename();
  const std::filesystem::path beside = document.file().parent_path();
  return (beside / compiler_attribute(document, folder) / file).lexically_normal();
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

std::vector<XMLElement*> elements_with(MjcfDocument& document, const char* tag, const char* name,
                                       const std::string& value) {
  std::vector<XMLElement*> found;
  for_each_element(document.root(), [&](XMLElement& e) {
    const XMLElement* const parent = e.Parent()->ToElement();
    const bool is_default = parent != nullptr && std::string_view(parent->Name()) == "default";
    if (std::string_view(e.Name()) == tag && !is_default &&
        attribute_or_default(document, e, name) == value) {
      found.push_back(&e);
    }
  });
  return found;
}

/// Whether a body's mass and inertia do not depend on one of its geoms.
bool has_own_mass(const MjcfDocument& document, const XMLElement& geom) {
  const XMLElement& body = *geom.Parent()->ToElement();
  if (body.FirstChildElement("inertial") != nullptr) return true;
  return numbers(attribute_or_default(document, geom, "mass")) == std::vector<double>{0.0};
}

std::string drop_mesh(MjcfDocument& document, XMLElement& mesh, const std::string& file) {
  const std::string name = name_of(mesh);
  for (XMLElement* const geom : elements_with(document, "geom", "mesh", name)) {
    if (!is_visual(document, *geom)) {
      document.fail(
          mesh, fmt::format("mesh '{}': {}: no such file, and {} of {} touches with it", name, file,
                            title_of(*geom), title_of(*geom->Parent()->ToElement())));
    }
    if (!has_own_mass(document, *geom)) {
      document.fail(mesh, fmt::format("mesh '{}': {}: no such file, and {} has its mass from it: "
                                      "expected an <inertial>",
                                      name, file, title_of(*geom->Parent()->ToElement())));
    }
    document.remove(*geom);
  }
  return fmt::format("mesh '{}': {}: no such file: not drawn", name, file);
}

std::string drop_texture(MjcfDocument& document, const XMLElement& texture,
                         const std::string& file) {
  const std::string name = name_of(texture);
  for (XMLElement* const material : elements_with(document, "material", "texture", name)) {
    material->DeleteAttribute("texture");
  }
  return fmt::format("texture '{}': {}: no such file: not drawn", name, file);
}

}  // namespace

std::vector<std::string> drop_missing_assets(MjcfDocument& document) {
  std::vector<std::string> notes;
  for (auto* section : children(document.root(), "asset")) {
    for (XMLElement* const asset : children(*section)) {
      const std::string_view tag = asset->Name();
      const bool is_mesh = tag == "mesh";
      if ((!is_mesh && tag != "texture") || asset->Attribute("file") == nullptr) continue;
      const std::filesystem::path file =
          file_of(document, *asset, is_mesh ? "meshdir" : "texturedir");
      if (!is_missing(file)) continue;
      notes.push_back(document.place_of(*asset) + ": " +
                      (is_mesh ? drop_mesh(document, *asset, file.string())
                               : drop_texture(document, *asset, file.string())));
      document.remove(*asset);
    }
  }
  return notes;
}

}  // namespace touchdown::models
