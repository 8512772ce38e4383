#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <tinyxml2.h>
#include <unordered_map>
#include <vector>

namespace touchdown::models {

/// A robot's XML file as a tree of elements, included files spliced in. Every element knows the
/// file and the line that it comes from.
class MjcfDocument {
 public:
  /// Reads a file and the files that it includes. As in MuJoCo, these are relative to the folder of
  /// the first one. Errors: `InputError` with file:line:column for anything that is not XML, a
  /// missing file or one that is included twice.
  static MjcfDocument load(const std::filesystem::path& file);
  /// Reads the MJCF that a URDF was converted to. Bodies, joints and geoms have the places of the
  /// links and joints of their names.
  static MjcfDocument converted(const std::string& text, const MjcfDocument& urdf);

  tinyxml2::XMLElement& root() { return *document_->RootElement(); }
  const tinyxml2::XMLElement& root() const { return *document_->RootElement(); }
  const std::filesystem::path& file() const { return file_; }
  /// This file, then those that it includes, in the order of reading.
  const std::vector<std::filesystem::path>& files() const { return files_; }

  /// "file:line:column" of an element.
  std::string place_of(const tinyxml2::XMLElement& element) const;

  /// Calls `visit` for every element, in the order of the file.
  void visit(const std::function<void(const tinyxml2::XMLElement&)>& visit) const;

  /// The first element with this tag and name, in the order of the file; null if there is none.
  tinyxml2::XMLElement* find(std::string_view tag, std::string_view name) const;

  /// Throws an `InputError` about an element.
  [[noreturn]] void fail(const tinyxml2::XMLElement& element, const std::string& message) const;

  /// Removes an element with all below it.
  void remove(tinyxml2::XMLElement& element);

  /// Adds an empty element to the end of another one. It has the place of `like`.
  tinyxml2::XMLElement& add(tinyxml2::XMLElement& parent, const char* tag,
                            const tinyxml2::XMLElement& like);
  /// The same to a section of the root, which is added if there is none.
  tinyxml2::XMLElement& add_to_section(const char* section, const char* tag,
                                       const tinyxml2::XMLElement& like);

  /// Parses elements and inserts them before `next`.
  void insert_before(tinyxml2::XMLElement& next, const std::string& elements);

  /// Moves an element, with all below it, before `next`.
  void move_before(tinyxml2::XMLElement& next, tinyxml2::XMLElement& element);

  /// The tree as text, one element per line. `more` is inserted before the end of the root.
  struct Text {
    std::string text;
    std::vector<std::string> place_of_line;  ///< file:line:column by line; empty where unknown
    /// The place of the line with a name in quotes, else of the robot's root.
    std::string place_of_name(const std::string& name) const;
  };
  Text text(const std::string& more) const;

 private:
  struct Place {
    std::filesystem::path file;
    int line = 0;
    int column = 0;
  };

  void inherit_places(const tinyxml2::XMLElement& element, const MjcfDocument& urdf, Place place);
  void expand(tinyxml2::XMLElement& element, const std::filesystem::path& folder);

  std::filesystem::path file_;
  std::vector<std::filesystem::path> files_;
  std::unique_ptr<tinyxml2::XMLDocument> document_;
  std::unordered_map<const tinyxml2::XMLElement*, Place> place_;
};

/// Calls `visit` for an element and all elements below it, in the order of the file.
void for_each_element(tinyxml2::XMLElement& element,
                      const std::function<void(tinyxml2::XMLElement&)>& visit);

/// The children of an element with a tag, or all of them, in their order. Each may be removed while
/// it is visited.
template <typename Element>
std::vector<Element*> children(Element& element, const char* tag = nullptr) {
  std::vector<Element*> all;
  for (Element* child = element.FirstChildElement(tag); child != nullptr;
       child = child->NextSiblingElement(tag)) {
    all.push_back(child);
  }
  return all;
}

/// The elements with a tag, or all, in all sections of a root, such as its <actuator>s.
template <typename Element>
std::vector<Element*> in_sections(Element& root, const char* section, const char* tag = nullptr) {
  std::vector<Element*> all;
  for (Element* const each : children(root, section)) {
    for (Element* const inside : children(*each, tag)) all.push_back(inside);
  }
  return all;
}

/// The value of an attribute, or "" if it is absent.
std::string_view attribute(const tinyxml2::XMLElement& element, const char* name);

/// "(did you mean 'y'?)", or ", found x, y, z" with the names that there are, for messages.
std::string found_text(std::string_view name, const std::vector<std::string>& names);

/// A short name of an element for messages: "joint 'left_hip'", or "geom" without a name.
std::string title_of(const tinyxml2::XMLElement& element);

/// The value of an element's attribute, or else that of its default class: the element's own class,
/// the `childclass` of the nearest body above it, or the main class; each with the classes around
/// it. Empty if none has it.
std::string_view attribute_or_default(const MjcfDocument& document,
                                      const tinyxml2::XMLElement& element, const char* name);

/// The numbers of an attribute; NaN for a word that is none.
std::vector<double> numbers(std::string_view text);

/// Whether a geom has no contact bit: it is drawn, and touches nothing.
bool is_visual(const MjcfDocument& document, const tinyxml2::XMLElement& geom);

}  // namespace touchdown::models
