#include "models/mjcf/document.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/files.hpp"
#include "core/yaml.hpp"

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

const XMLElement* parent_of(const XMLElement& element) {
  return element.Parent() == nullptr ? nullptr : element.Parent()->ToElement();
}

bool is_default(const XMLElement* element) {
  return element != nullptr && std::string_view(element->Name()) == "default";
}

/// The name of the class that counts for an element; empty for the main class.
std::string_view class_of(const XMLElement& element) {
  if (const std::string_view own = attribute(element, "class"); !own.empty()) return own;
  for (const XMLElement* above = parent_of(element); above != nullptr; above = parent_of(*above)) {
    if (const auto child = attribute(*above, "childclass"); !child.empty()) return child;
  }
  return {};
}

/// The <default> of a class; null if there is none.
const XMLElement* default_of(const MjcfDocument& document, std::string_view name) {
  const XMLElement* found = nullptr;
  document.visit([&](const XMLElement& element) {
    if (found != nullptr || !is_default(&element)) return;
    const bool is_main = !is_default(parent_of(element));
    if (name.empty() ? is_main : attribute(element, "class") == name) found = &element;
  });
  return found;
}

/// The columns of a file's elements, in its order: the parser counts lines alone.
class Columns {
 public:
  explicit Columns(std::string text) : text_(std::move(text)) {}

  const std::string& text() const { return text_; }
  int of(const XMLElement& element) {
    for (; line_ < element.GetLineNum(); ++line_) {
      at_ = begin_ = std::min(text_.find('\n', begin_), text_.size() - 1) + 1;
    }
    const std::size_t found = text_.find(std::string("<") + element.Name(), at_);
    if (found >= std::min(text_.find('\n', at_), text_.size())) return 1;
    at_ = found + 1;
    return static_cast<int>(at_ - begin_);
  }

 private:
  std::string text_;
  int line_ = 1;
  std::size_t begin_ = 0;  ///< of the line
  std::size_t at_ = 0;     ///< behind the last element's
};

std::unique_ptr<tinyxml2::XMLDocument> parsed(const std::string& text,
                                              const std::filesystem::path& file) {
  auto document = std::make_unique<tinyxml2::XMLDocument>();
  if (document->Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError(fmt::format("{}:{}:1: expected well-formed XML ({})", file.string(),
                                 std::max(document->ErrorLineNum(), 1), document->ErrorName()));
  }
  if (document->RootElement() == nullptr) {
    throw InputError(
        fmt::format("{}:1:1: expected a robot in <mujoco>...</mujoco>", file.string()));
  }
  return document;
}

/// An attribute's value as XML text on one line.
std::string escaped(std::string_view value) {
  std::string text;
  for (const char c : value) {
    switch (c) {
      case '&':
        text += "&amp;";
        break;
      case '<':
        text += "&lt;";
        break;
      case '"':
        text += "&quot;";
        break;
      case '\n':
      case '\r':
        text += ' ';
        break;
      default:
        text += c;
    }
  }
  return text;
}

std::string start_of(const XMLElement& element, const char* end) {
  std::string text = fmt::format("<{}", element.Name());
  for (const auto* a = element.FirstAttribute(); a != nullptr; a = a->Next()) {
    text += fmt::format(" {}=\"{}\"", a->Name(), escaped(a->Value()));
  }
  return text + end + "\n";
}

}  // namespace

std::string_view attribute_or_default(const MjcfDocument& document, const XMLElement& element,
                                      const char* name) {
  if (element.Attribute(name) != nullptr) return attribute(element, name);
  const XMLElement* at = default_of(document, class_of(element));
  for (; is_default(at); at = parent_of(*at)) {
    for (const auto* e = at->FirstChildElement(element.Name()); e != nullptr;
         e = e->NextSiblingElement(element.Name())) {
      if (e->Attribute(name) != nullptr) return attribute(*e, name);
    }
  }
  return {};
}

std::vector<double> numbers(std::string_view text) {
  std::vector<double> all;
  std::istringstream words{std::string(text)};
  for (std::string word; words >> word;) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    all.push_back(*end == '\0' ? value : std::nan(""));
  }
  return all;
}

bool is_visual(const MjcfDocument& document, const XMLElement& geom) {
  const auto is_none = [&](const char* bit) {
    return numbers(attribute_or_default(document, geom, bit)) == std::vector<double>{0.0};
  };
  return is_none("contype") && is_none("conaffinity");
}

MjcfDocument MjcfDocument::load(const std::filesystem::path& file) {
  MjcfDocument document;
  document.file_ = file;
  Columns columns(read_file(file));
  document.document_ = parsed(columns.text(), file);
  for_each_element(document.root(), [&](XMLElement& element) {
    document.place_[&element] = {file, element.GetLineNum(), columns.of(element)};
  });
  document.files_ = {file.lexically_normal()};
  document.expand(document.root(), file.parent_path());
  return document;
}

MjcfDocument MjcfDocument::converted(const std::string& text, const MjcfDocument& urdf) {
  MjcfDocument document;
  document.file_ = urdf.file_;
  document.document_ = parsed(text, urdf.file_);
  document.inherit_places(document.root(), urdf, urdf.place_.at(&urdf.root()));
  return document;
}

void MjcfDocument::inherit_places(const XMLElement& element, const MjcfDocument& urdf,
                                  Place place) {
  const std::string_view tag = element.Name();
  const char* const counterpart = tag == "body" ? "link" : tag == "joint" ? "joint" : nullptr;
  if (counterpart != nullptr) {
    const XMLElement* const origin = urdf.find(counterpart, attribute(element, "name"));
    if (origin != nullptr) place = urdf.place_.at(origin);
  }
  place_[&element] = place;
  for (auto* child : children(element)) {
    inherit_places(*child, urdf, place);
  }
}

void MjcfDocument::expand(XMLElement& element, const std::filesystem::path& folder) {
  for (XMLElement* child = element.FirstChildElement(); child != nullptr;) {
    XMLElement* const next = child->NextSiblingElement();
    if (std::string_view(child->Name()) != "include") {
      expand(*child, folder);
      child = next;
      continue;
    }
    const std::filesystem::path file =
        (folder / std::string(attribute(*child, "file"))).lexically_normal();
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) {
      fail(*child, fmt::format("include: {}: no such file", file.string()));
    }
    if (std::find(files_.begin(), files_.end(), file) != files_.end()) {
      fail(*child, fmt::format("include: {} is included already", file.string()));
    }
    files_.push_back(file);
    Columns columns(read_file(file));
    const auto other = parsed(columns.text(), file);
    // Clones have no line numbers, so those of the original are kept for them.
    const std::function<void(const XMLElement&, const XMLElement&)> keep_places =
        [&](const XMLElement& clone, const XMLElement& original) {
          place_[&clone] = {file, original.GetLineNum(), columns.of(original)};
          const XMLElement* from = original.FirstChildElement();
          for (const auto* to = clone.FirstChildElement(); to != nullptr;
               to = to->NextSiblingElement(), from = from->NextSiblingElement()) {
            keep_places(*to, *from);
          }
        };
    tinyxml2::XMLNode* last = child;
    XMLElement* first = nullptr;
    for (auto* from : children(*other->RootElement())) {
      XMLElement* const clone = from->DeepClone(document_.get())->ToElement();
      keep_places(*clone, *from);
      last = element.InsertAfterChild(last, clone);
      if (first == nullptr) first = clone;
    }
    remove(*child);
    child = first != nullptr ? first : next;  // the included elements may include others
  }
}

std::string MjcfDocument::place_of(const XMLElement& element) const {
  const auto place = place_.find(&element);
  if (place == place_.end()) return file_.string();
  const auto& [file, line, column] = place->second;
  return fmt::format("{}:{}:{}", file.string(), line, column);
}

void MjcfDocument::visit(const std::function<void(const XMLElement&)>& visit) const {
  for_each_element(*document_->RootElement(), [&](XMLElement& element) { visit(element); });
}

std::string MjcfDocument::Text::place_of_name(const std::string& name) const {
  std::string root;
  const std::string quoted = fmt::format("name=\"{}\"", escaped(name));
  std::size_t begin = 0;
  for (const std::string& place : place_of_line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line(text.data() + begin, end - begin);
    if (root.empty()) root = place;
    if (!name.empty() && !place.empty() && line.find(quoted) != std::string_view::npos)
      return place;
    begin = std::min(end + 1, text.size());
  }
  return root;
}

XMLElement* MjcfDocument::find(std::string_view tag, std::string_view name) const {
  XMLElement* found = nullptr;
  for_each_element(*document_->RootElement(), [&](XMLElement& element) {
    if (found == nullptr && tag == element.Name() && attribute(element, "name") == name) {
      found = &element;
    }
  });
  return found;
}

void MjcfDocument::fail(const XMLElement& element, const std::string& message) const {
  throw InputError(place_of(element) + ": " + message);
}

void MjcfDocument::remove(XMLElement& element) {
  // Elements that are added later may have the same addresses.
  for_each_element(element, [this](XMLElement& one) { place_.erase(&one); });
  element.Parent()->DeleteChild(&element);
}

XMLElement& MjcfDocument::add(XMLElement& parent, const char* tag, const XMLElement& like) {
  XMLElement* const added = parent.InsertNewChildElement(tag);
  if (const auto place = place_.find(&like); place != place_.end()) place_[added] = place->second;
  return *added;
}

XMLElement& MjcfDocument::add_to_section(const char* section, const char* tag,
                                         const XMLElement& like) {
  XMLElement* const found = root().FirstChildElement(section);
  return add(found != nullptr ? *found : add(root(), section, like), tag, like);
}

void MjcfDocument::insert_before(XMLElement& next, const std::string& elements) {
  const auto added = parsed("<added>" + elements + "</added>", file_);
  for (auto* from : children(*added->RootElement())) {
    move_before(next, *from->DeepClone(document_.get())->ToElement());
  }
}

void MjcfDocument::move_before(XMLElement& next, XMLElement& element) {
  tinyxml2::XMLNode* const parent = next.Parent();
  tinyxml2::XMLNode* const before = next.PreviousSibling();
  before == nullptr ? parent->InsertFirstChild(&element)
                    : parent->InsertAfterChild(before, &element);
}

MjcfDocument::Text MjcfDocument::text(const std::string& more) const {
  Text written;
  const std::function<void(const XMLElement&)> write = [&](const XMLElement& element) {
    const auto add = [&](const std::string& line) {
      written.text += line;
      written.place_of_line.push_back(place_.contains(&element) ? place_of(element) : "");
    };
    const bool is_root = &element == &root();
    const XMLElement* child = element.FirstChildElement();
    if (child == nullptr && !is_root) {
      add(start_of(element, "/>"));
      return;
    }
    add(start_of(element, ">"));
    for (; child != nullptr; child = child->NextSiblingElement()) write(*child);
    if (is_root) {
      written.text += more;
      written.place_of_line.resize(
          written.place_of_line.size() +
          static_cast<std::size_t>(std::count(more.begin(), more.end(), '\n')));
    }
    add(fmt::format("</{}>\n", element.Name()));
  };
  write(root());
  return written;
}

void for_each_element(XMLElement& element, const std::function<void(XMLElement&)>& visit) {
  visit(element);
  for (auto* child : children(element)) {
    for_each_element(*child, visit);
  }
}

std::string_view attribute(const XMLElement& element, const char* name) {
  const char* const value = element.Attribute(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

std::string found_text(std::string_view name, const std::vector<std::string>& names) {
  std::string near = did_you_mean(name, names);
  if (!near.empty()) return near;
  return names.empty() ? ", found none" : fmt::format(", found {}", fmt::join(names, ", "));
}

std::string title_of(const XMLElement& element) {
  const std::string_view name = attribute(element, "name");
  return name.empty() ? element.Name() : fmt::format("{} '{}'", element.Name(), name);
}

}  // namespace touchdown::models
