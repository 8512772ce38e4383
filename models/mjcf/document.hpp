#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <tinyxml2.h>
#include <unordered_map>
#include <vector>

namespace touchdown::models {

/// A robot's XML file as its author wrote it, with the files that it includes in their places. Its
/// elements are read from a tree; edits change the text, and keep its lines.
class MjcfDocument {
 public:
  /// Reads a file and the files that it includes. As in MuJoCo, these are relative to the folder of
  /// the first one. Errors: `InputError` with file:line:column for anything that is not XML, a
  /// missing file or one that is included twice, names with control characters, and attributes
  /// with NaN, infinity or hexadecimal numbers.
  static MjcfDocument load(const std::filesystem::path& file);
  /// The MJCF that a URDF was converted to. Bodies and joints have the places of the links and
  /// joints of their names.
  static MjcfDocument converted(std::string text, std::shared_ptr<const MjcfDocument> urdf);

  tinyxml2::XMLElement& root() const { return *tree_->RootElement(); }
  const std::filesystem::path& file() const { return files_.front(); }
  /// This file, then those that it includes, in the order of reading.
  const std::vector<std::filesystem::path>& files() const { return files_; }

  /// Calls `visit` for every element, in the order of the file.
  void visit(const std::function<void(tinyxml2::XMLElement&)>& visit) const;
  /// The first element with this tag and name, in the order of the file; null if there is none.
  tinyxml2::XMLElement* find(std::string_view tag, std::string_view name) const;

  /// "file:line:column" of an element.
  std::string place_of(const tinyxml2::XMLElement& element) const;
  /// The place of an element that begins in a line of `edited`, the one with a name if there are
  /// several; 0 stands for any line. That of the root if there is none.
  std::string place_in(int line, std::string_view name) const;
  /// Throws an `InputError` about an element.
  [[noreturn]] void fail(const tinyxml2::XMLElement& element, const std::string& message) const;

  /// The text of an element.
  std::string text_of(const tinyxml2::XMLElement& element) const;
  /// Removes an element with all below it.
  void remove(tinyxml2::XMLElement& element);
  /// Removes an element, whose children take its place.
  void unwrap(tinyxml2::XMLElement& element);
  /// Adds an attribute that an element does not have.
  void set(tinyxml2::XMLElement& element, const char* attribute, const std::string& value);
  /// Gives an attribute another name and value; without a name it is removed.
  void replace(tinyxml2::XMLElement& element, const char* attribute, const std::string& name = {},
               const std::string& value = {});
  /// Inserts text, on its line, before an element, behind its start tag, or before its end tag. The
  /// tree does not have it.
  void insert_before(const tinyxml2::XMLElement& element, const std::string& text);
  void insert_first(const tinyxml2::XMLElement& element, const std::string& text);
  void insert_last(const tinyxml2::XMLElement& element, const std::string& text);

  /// The text with all edits, and `more` before the end of the root.
  std::string edited(const std::string& more = {}) const;

 private:
  /// Where an element's start tag begins, and where it and the element end.
  struct Span {
    std::size_t begin = 0, head = 0, end = 0;
  };
  /// Text of one file, from a place in it.
  struct Piece {
    std::size_t file = 0;  ///< of `files_`
    int line = 1, column = 1;
  };
  /// Text in place of other text, whose line breaks stay.
  struct Edit {
    std::size_t at = 0, length = 0;
    std::string text;
  };

  void add_file(const std::filesystem::path& file, const std::filesystem::path& folder);
  void parse();
  const Span& span(const tinyxml2::XMLElement& element) const { return span_.at(&element); }
  std::size_t end_tag(const tinyxml2::XMLElement& element) const;

  std::vector<std::filesystem::path> files_;
  std::string text_;
  std::map<std::size_t, Piece> pieces_;  ///< by where they begin in `text_`
  std::unique_ptr<tinyxml2::XMLDocument> tree_;
  std::unordered_map<const tinyxml2::XMLElement*, Span> span_;
  std::shared_ptr<const MjcfDocument> urdf_;
  std::vector<Edit> edits_;
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

/// The numbers of an attribute; NaN for a word that is no finite decimal number.
std::vector<double> numbers(std::string_view text);

/// Whether a geom has no contact bit: it is drawn, and touches nothing.
bool is_visual(const MjcfDocument& document, const tinyxml2::XMLElement& geom);

}  // namespace touchdown::models
