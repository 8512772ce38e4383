#include "models/mjcf/document.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/files.hpp"
#include "core/terminal_text.hpp"
#include "core/yaml.hpp"

namespace touchdown::models {

namespace {

using tinyxml2::XMLElement;

constexpr std::string_view spaces = " \t\r\n";

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

/// Where the elements of a text begin, where their start tags end and where they end, in the order
/// of the text. The text is well-formed: the parser, which counts lines alone, has read it.
std::vector<std::array<std::size_t, 3>> spans_of(const std::string& text) {
  std::vector<std::array<std::size_t, 3>> spans;
  std::vector<std::size_t> open;
  const auto behind = [&](std::string_view end, std::size_t from) {
    return std::min(text.find(end, from), text.size() - end.size()) + end.size();
  };
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    const std::string_view rest = std::string_view(text).substr(at);
    if (rest.starts_with("<!--")) {
      at = behind("-->", at);
    } else if (rest.starts_with("<![CDATA[")) {
      at = behind("]]>", at);
    } else if (rest.starts_with("<!") || rest.starts_with("<?")) {
      at = behind(">", at);
    } else if (rest.starts_with("</")) {
      at = behind(">", at);
      if (open.empty()) continue;
      spans[open.back()][2] = at;
      open.pop_back();
    } else {
      std::size_t end = at;
      for (char quote = 0; end + 1 < text.size() && (text[end] != '>' || quote != 0); ++end) {
        if (quote != 0 ? text[end] == quote : text[end] == '"' || text[end] == '\'') {
          quote = quote != 0 ? '\0' : text[end];
        }
      }
      if (text[end - 1] != '/') open.push_back(spans.size());
      spans.push_back({at, end + 1, end + 1});
      at = end + 1;
    }
  }
  return spans;
}

/// Line and column of a place in a text that begins at `line` and `column`.
std::pair<int, int> place_in_text(std::string_view text, int line, int column) {
  const auto breaks = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  const std::size_t last = text.rfind('\n');
  if (last == std::string_view::npos) return {line, column + static_cast<int>(text.size())};
  return {line + breaks, static_cast<int>(text.size() - last)};
}

/// An attribute as XML text.
std::string assignment(std::string_view attribute, const std::string& value) {
  tinyxml2::XMLPrinter escaped;
  escaped.PushText(value.c_str());
  return fmt::format("{}=\"{}\"", attribute, escaped.CStr());
}

void for_each_in(tinyxml2::XMLDocument& tree, const std::function<void(XMLElement&)>& visit) {
  for (auto* e = tree.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
    for_each_element(*e, visit);
  }
}

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

/// Whether a word is a number to C's `strtod` but no finite decimal one. MuJoCo takes some for 0.
bool is_strange_number(const std::string& word) {
  char* end = nullptr;
  (void)std::strtod(word.c_str(), &end);
  return !word.empty() && *end == '\0' && std::isnan(numbers(word).front());
}

/// Refuses names that neither a YAML file nor a message can hold, and strange numbers. What is the
/// name of an element is no number.
void check_attributes(const MjcfDocument& document) {
  std::set<std::string_view> names;
  document.visit([&](const XMLElement& element) { names.insert(attribute(element, "name")); });
  document.visit([&](const XMLElement& element) {
    const std::string_view name = attribute(element, "name");
    if (const std::string shown = terminal_text(name); shown != name) {
      document.fail(element, fmt::format("{}: name: expected one without control characters, found "
                                         "'{}'",
                                         element.Name(), shown));
    }
    for (const auto* a = element.FirstAttribute(); a != nullptr; a = a->Next()) {
      // A URDF's limit of velocity is not used.
      if (names.contains(a->Value()) || a->Name() == std::string_view("velocity")) continue;
      std::istringstream words(a->Value());
      for (std::string word; words >> word;) {
        if (!is_strange_number(word)) continue;
        document.fail(element, fmt::format("{}: {}: expected finite decimal numbers, found '{}'",
                                           title_of(element), a->Name(), word));
      }
    }
  });
}

/// The spans of a tree's elements in its text.
std::vector<std::array<std::size_t, 3>> spans_in(tinyxml2::XMLDocument& tree,
                                                 const std::string& text,
                                                 const std::filesystem::path& file) {
  std::vector<std::array<std::size_t, 3>> spans = spans_of(text);
  std::size_t elements = 0;
  for_each_in(tree, [&](XMLElement&) { ++elements; });
  if (elements == spans.size()) return spans;
  throw InputError(fmt::format("{}:1:1: expected well-formed XML", file.string()));
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
    const bool is_decimal =
        *end == '\0' && std::isfinite(value) && word.find_first_of("xX") == std::string::npos;
    all.push_back(is_decimal ? value : std::nan(""));
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
  document.add_file(file, file.parent_path());
  document.files_.front() = file;
  document.parse();
  check_attributes(document);
  return document;
}

MjcfDocument MjcfDocument::converted(std::string text, std::shared_ptr<const MjcfDocument> urdf) {
  MjcfDocument document;
  document.files_ = {urdf->file()};
  document.text_ = std::move(text);
  document.urdf_ = std::move(urdf);
  document.parse();
  return document;
}

void MjcfDocument::parse() {
  tree_ = parsed(text_, file());
  const auto spans = spans_in(*tree_, text_, file());
  std::size_t number = 0;
  for_each_in(*tree_, [&](XMLElement& element) {
    const auto [begin, head, end] = spans.at(number++);
    span_[&element] = {begin, head, end};
  });
}

void MjcfDocument::add_file(const std::filesystem::path& file,
                            const std::filesystem::path& folder) {
  const bool is_first = files_.empty();
  const std::size_t number = files_.size();
  files_.push_back(file.lexically_normal());
  const std::string text = read_file(file);
  const auto tree = parsed(text, file);
  const auto spans = spans_in(*tree, text, file);
  const auto add = [&](std::size_t begin, std::size_t end) {
    const auto [line, column] = place_in_text(std::string_view(text).substr(0, begin), 1, 1);
    pieces_[text_.size()] = {number, line, column};
    text_.append(text, begin, end - begin);
  };
  std::size_t from = is_first ? 0 : spans.at(0)[1];
  std::size_t index = 0;
  for_each_in(*tree, [&](XMLElement& element) {
    const auto [begin, head, end] = spans.at(index++);
    if (std::string_view(element.Name()) != "include") return;
    add(from, begin);
    from = end;
    const std::filesystem::path other =
        (folder / std::string(attribute(element, "file"))).lexically_normal();
    const auto fail = [&, before = std::string_view(text).substr(0, begin)](const auto& message) {
      const auto [line, column] = place_in_text(before, 1, 1);
      throw InputError(fmt::format("{}:{}:{}: include: {}", file.string(), line, column, message));
    };
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(other, ignored)) {
      fail(fmt::format("{}: no such file", other.string()));
    }
    if (std::ranges::count(files_, other) > 0) {
      fail(fmt::format("{} is included already", other.string()));
    }
    add_file(other, folder);
  });
  const std::size_t end = is_first ? text.size() : text.rfind("</", spans.at(0)[2]);
  if (from < end) add(from, std::min(end, text.size()));
}

void MjcfDocument::visit(const std::function<void(XMLElement&)>& visit) const {
  for_each_in(*tree_, visit);
}

XMLElement* MjcfDocument::find(std::string_view tag, std::string_view name) const {
  XMLElement* found = nullptr;
  visit([&](XMLElement& element) {
    if (found == nullptr && tag == element.Name() && attribute(element, "name") == name) {
      found = &element;
    }
  });
  return found;
}

std::string MjcfDocument::place_of(const XMLElement& element) const {
  if (urdf_ == nullptr) {
    const std::size_t at = span(element).begin;
    const auto& [begin, piece] = *std::prev(pieces_.upper_bound(at));
    const auto [line, column] =
        place_in_text(std::string_view(text_).substr(begin, at - begin), piece.line, piece.column);
    return fmt::format("{}:{}:{}", files_[piece.file].string(), line, column);
  }
  for (const XMLElement* e = &element; e != nullptr; e = parent_of(*e)) {
    const std::string_view tag = std::string_view(e->Name()) == "body" ? "link" : e->Name();
    const XMLElement* const origin = urdf_->find(tag, attribute(*e, "name"));
    if (origin != nullptr && tag != "geom") return urdf_->place_of(*origin);
  }
  return urdf_->place_of(urdf_->root());
}

std::string MjcfDocument::place_in(int line, std::string_view name) const {
  const XMLElement* found = nullptr;
  bool has_name = false;
  visit([&](XMLElement& element) {
    const std::string_view before = std::string_view(text_).substr(0, span(element).begin);
    const bool is_named = name == attribute(element, "name") || name == element.Name();
    if (has_name || (line > 0 ? 1 + std::ranges::count(before, '\n') != line : !is_named)) return;
    if (found == nullptr || is_named) found = &element;
    has_name = is_named;
  });
  return place_of(found == nullptr ? root() : *found);
}

void MjcfDocument::fail(const XMLElement& element, const std::string& message) const {
  throw InputError(place_of(element) + ": " + message);
}

std::string MjcfDocument::text_of(const XMLElement& element) const {
  return text_.substr(span(element).begin, span(element).end - span(element).begin);
}

std::size_t MjcfDocument::end_tag(const XMLElement& element) const {
  return span(element).end == span(element).head ? span(element).head
                                                 : text_.rfind("</", span(element).end - 1);
}

void MjcfDocument::remove(XMLElement& element) {
  edits_.push_back({span(element).begin, span(element).end - span(element).begin, ""});
  // Elements that are added later may have the same addresses.
  for_each_element(element, [this](XMLElement& one) { span_.erase(&one); });
  element.Parent()->DeleteChild(&element);
}

void MjcfDocument::unwrap(XMLElement& element) {
  const auto [begin, head, end] = span(element);
  edits_.push_back({begin, head - begin, ""});
  edits_.push_back({end_tag(element), end - end_tag(element), ""});
  tinyxml2::XMLNode* last = &element;
  for (XMLElement* const child : children(element)) {
    last = element.Parent()->InsertAfterChild(last, child);
  }
  span_.erase(&element);
  element.Parent()->DeleteChild(&element);
}

void MjcfDocument::set(XMLElement& element, const char* attribute, const std::string& value) {
  edits_.push_back({span(element).begin + 1 + std::string_view(element.Name()).size(), 0,
                    fmt::format(" {}", assignment(attribute, value))});
  element.SetAttribute(attribute, value.c_str());
}

void MjcfDocument::replace(XMLElement& element, const char* attribute, const std::string& name,
                           const std::string& value) {
  if (element.Attribute(attribute) == nullptr) return;
  std::size_t begin = text_.find_first_of(spaces, span(element).begin);
  while (begin < span(element).head) {
    begin = text_.find_first_not_of(spaces, begin);
    const std::size_t quote = text_.find_first_of("\"'", begin);
    const std::size_t end = text_.find(text_[quote], quote + 1) + 1;
    const std::string_view own(text_.data() + begin, quote - begin);
    if (own.substr(0, own.find_first_of(" \t\r\n=")) == attribute) {
      edits_.push_back({begin, end - begin, name.empty() ? "" : assignment(name, value)});
      break;
    }
    begin = end;
  }
  element.DeleteAttribute(attribute);
  if (!name.empty()) element.SetAttribute(name.c_str(), value.c_str());
}

void MjcfDocument::insert_before(const XMLElement& element, const std::string& text) {
  edits_.push_back({span(element).begin, 0, text});
}

void MjcfDocument::insert_first(const XMLElement& element, const std::string& text) {
  edits_.push_back({span(element).head, 0, text});
}

void MjcfDocument::insert_last(const XMLElement& element, const std::string& text) {
  const auto [begin, head, end] = span(element);
  if (head < end) {
    edits_.push_back({end_tag(element), 0, text});
  } else {
    edits_.push_back({head - 2, 2, fmt::format(">{}</{}>", text, element.Name())});
  }
}

std::string MjcfDocument::edited(const std::string& more) const {
  std::vector<Edit> edits = edits_;
  edits.push_back({end_tag(root()), 0, more});
  std::ranges::stable_sort(edits, {}, [](const Edit& edit) {
    return std::pair(edit.at, edit.length > 0);  // what is inserted before a removed element stays
  });
  std::string text;
  std::size_t from = 0;
  for (const Edit& edit : edits) {
    if (edit.at < from) continue;  // in text that is gone
    text.append(text_, from, edit.at - from);
    from = edit.at + edit.length;
    text += edit.text;
    text.append(static_cast<std::size_t>(
                    std::count(text_.begin() + static_cast<std::ptrdiff_t>(edit.at),
                               text_.begin() + static_cast<std::ptrdiff_t>(from), '\n')),
                '\n');
  }
  return text.append(text_, from);
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
