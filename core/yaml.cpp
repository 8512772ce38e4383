#include "core/yaml.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <yaml-cpp/eventhandler.h>

#include "core/files.hpp"
#include "core/terminal_text.hpp"

namespace touchdown {

namespace {

constexpr std::size_t most_levels = 64;
constexpr std::size_t most_values = 1'000'000;

using MarkFormatter = std::function<std::string(const YAML::Mark&)>;

YAML::Mark mark_behind(std::string_view text) {
  const std::size_t line_end = text.rfind('\n');
  const std::string_view line =
      line_end == std::string_view::npos ? text : text.substr(line_end + 1);
  YAML::Mark mark;
  mark.pos = static_cast<int>(text.size());
  mark.line = static_cast<int>(std::ranges::count(text, '\n'));
  mark.column = static_cast<int>(std::ranges::count_if(
      line, [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }));
  return mark;
}

/// Counts values and nesting levels during parsing and rejects what exceeds the limits.
class Checker : public YAML::EventHandler {
 public:
  explicit Checker(const MarkFormatter& place) : place_(place) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (has_document_) complain(mark, "expected the end: one file holds one YAML document");
    has_document_ = true;
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    begin_value(mark, false);
    end_value(mark, anchor, {});
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    begin_value(mark, false);
    const auto size = sizes_.find(anchor);
    if (size == sizes_.end()) complain(mark, "an alias is inside the value that it refers to");
    if (open_.size() + size->second.levels > most_levels) complain_about_levels(mark);
    end_value(mark, YAML::anchor_t{}, size->second);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    const bool is_key = is_key_next();
    begin_value(mark, true);
    const bool is_quoted = tag == "!";
    if (!is_key && !is_quoted && has_leading_zero(value)) {
      complain(mark, fmt::format("{0}: a number has no leading zero; a text needs quotes: "
                                 "\"{0}\"",
                                 value));
    }
    if (const std::string shown = terminal_text(value, "\n\t"); shown != value) {
      complain(mark, fmt::format("'{}': a text has no control characters", shown));
    }
    if (is_key && value == "<<") {
      complain(mark, "<<: merged keys are not read: repeat them");
    }
    if (is_key && !open_.back().keys.insert(value).second) {
      complain(mark, value + ": appears twice");
    }
    end_value(mark, anchor, {});
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    open(mark, anchor, false);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    open(mark, anchor, true);
  }
  void OnMapEnd() override { close(); }

 private:
  /// Size of a value, including everything nested in it.
  struct Size {
    std::size_t values = 1;
    std::size_t levels = 1;
  };
  /// A list or mapping that has not ended yet.
  struct Open {
    YAML::Mark mark;
    YAML::anchor_t anchor;
    bool is_map;
    bool is_key_next;
    Size size = {};
    std::set<std::string> keys = {};
  };

  [[noreturn]] void complain(const YAML::Mark& mark, const std::string& message) const {
    throw InputError(place_(mark) + ": " + message);
  }
  [[noreturn]] void complain_about_levels(const YAML::Mark& mark) const {
    complain(mark, fmt::format("nested deeper than {} levels", most_levels));
  }

  bool is_key_next() const { return !open_.empty() && open_.back().is_key_next; }

  void begin_value(const YAML::Mark& mark, bool is_name) {
    if (is_key_next() && !is_name) complain(mark, "expected a name as a key");
    if (open_.size() >= most_levels) complain_about_levels(mark);
  }

  void end_value(const YAML::Mark& mark, YAML::anchor_t anchor, const Size& size) {
    if (anchor != YAML::anchor_t{}) sizes_[anchor] = size;
    if (open_.empty()) return;
    Open& parent = open_.back();
    parent.is_key_next = parent.is_map && !parent.is_key_next;
    parent.size.values += size.values;
    parent.size.levels = std::max(parent.size.levels, size.levels + 1);
    if (parent.size.values > most_values) {
      complain(mark, fmt::format("more than {} values, aliases expanded", most_values));
    }
  }

  void open(const YAML::Mark& mark, YAML::anchor_t anchor, bool is_map) {
    begin_value(mark, false);
    open_.push_back({mark, anchor, is_map, is_map});
  }

  void close() {
    const Open ended = open_.back();
    open_.pop_back();
    end_value(ended.mark, ended.anchor, ended.size);
  }

  const MarkFormatter& place_;
  bool has_document_ = false;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Size> sizes_;  ///< of the anchored values
};

/// Checks a YAML text before it becomes a node tree. The tree of a valid text has no cycles and a
/// limited size. Errors: `InputError`, which begins with the result of `place` for the mark, for
/// - bytes that are not UTF-8, and a second document;
/// - an alias inside the value that it refers to;
/// - more than 64 levels or a million values, aliases expanded;
/// - a key that is not a name, or is there already: yaml-cpp keeps the first and ignores the
/// second;
/// - a number with a leading zero, such as 010, which some parsers read as octal and others as
///   decimal. In quotes it is a text;
/// - a text that a terminal would obey, because names go into tables and pages.
/// Malformed YAML throws yaml-cpp's `ParserException`.
void check_yaml_text(const std::string& text, const MarkFormatter& place) {
  const std::size_t valid = utf8_size(text);
  if (valid < text.size()) {
    throw InputError(fmt::format("{}: not UTF-8: byte 0x{:02x}",
                                 place(mark_behind(std::string_view(text).substr(0, valid))),
                                 static_cast<unsigned char>(text[valid])));
  }
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  Checker checker(place);
  while (parser.HandleNextDocument(checker)) {
  }
}

/// The first tab that indents a line, up to the line of a parser's error.
std::optional<YAML::Mark> first_tab(const std::string& text, int last_line) {
  std::istringstream lines(text);
  YAML::Mark mark;
  for (std::string line; mark.line <= last_line && std::getline(lines, line); ++mark.line) {
    const std::size_t indent = line.find_first_not_of(' ');
    if (indent == std::string::npos || line[indent] != '\t') continue;
    mark.column = static_cast<int>(indent);
    return mark;
  }
  return std::nullopt;
}

YAML::Node parse_or_complain(const std::string& text, const std::string& name) {
  const auto place = [&](const YAML::Mark& mark) {
    return fmt::format("{}:{}:{}", name, mark.line + 1, mark.column + 1);
  };
  try {
    check_yaml_text(text, place);
    YAML::Node root = YAML::Load(text);
    if (!root.IsMap()) {
      throw InputError(fmt::format("{}:1:1: expected a mapping of keys to values", name));
    }
    return root;
  } catch (const YAML::ParserException& error) {
    const std::optional<YAML::Mark> tab = first_tab(text, error.mark.line);
    throw InputError(fmt::format("{}: not valid YAML: {}", place(tab.value_or(error.mark)),
                                 tab ? "a tab indents the line: indent it by spaces" : error.msg));
  }
}

/// Returns the node at `key` below `parent`. List items are addressed by number.
YAML::Node descend(YAML::Node parent, const std::string& key, std::string_view assignment) {
  if (!parent.IsSequence()) return parent[key];
  std::size_t item = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), item);
  if (error != std::errc{} || end != key.data() + key.size() || item >= parent.size()) {
    throw InputError(fmt::format("--set {}: '{}' is not the number of an item (0 to {})",
                                 assignment, key, parent.size() - 1));
  }
  return parent[item];
}

}  // namespace

bool has_leading_zero(std::string_view number) {
  if (number.starts_with('-') || number.starts_with('+')) number.remove_prefix(1);
  return number.size() > 1 && number.starts_with('0') &&
         std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// What a file of another kind is, and what takes it; empty for one that may be YAML.
static std::string other_kind(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  const auto is_one_of = [&](std::initializer_list<std::string_view> extensions) {
    return std::ranges::find(extensions, extension) != extensions.end();
  };
  if (is_one_of({".mpack"})) return "a recording, which `touchdown estimate` and `render` take";
  if (is_one_of({".mcap", ".db3", ".bag"})) return "a bag, which `estimate --mapping` takes";
  if (is_one_of({".xml", ".urdf"})) return "a robot, which `touchdown check` takes";
  if (is_one_of({".csv", ".npz"})) return "a table or arrays";
  return {};
}

YamlDocument YamlDocument::load(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  if (const std::string kind = other_kind(path); !kind.empty()) {
    throw InputError(fmt::format("{}: is {}: expected a YAML file", path.string(), kind));
  }
  return parse(text, path.string());
}

YamlDocument YamlDocument::parse(const std::string& text, const std::string& name) {
  YamlDocument document;
  document.name_ = name;
  document.root_ = parse_or_complain(text, name);
  document.origins_ = {{"", name, false, document.root_.Mark()}};
  return document;
}

void YamlDocument::override_value(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw InputError(fmt::format("--set {}: expected key=value", assignment));
  }
  YAML::Node value;
  try {
    const std::string text(assignment.substr(equals + 1));
    check_yaml_text(text, [&](const YAML::Mark&) { return fmt::format("--set {}", assignment); });
    value = YAML::Load(text);
  } catch (const YAML::ParserException& error) {
    throw InputError(fmt::format("--set {}: not a YAML value: {}", assignment, error.msg));
  }
  std::vector<std::string> keys;
  std::stringstream dotted{std::string(assignment.substr(0, equals)) + "."};
  for (std::string key; std::getline(dotted, key, '.');) {
    if (key.empty()) {
      throw InputError(fmt::format("--set {}: expected names between the dots", assignment));
    }
    keys.push_back(key);
  }
  const std::string name(assignment.substr(0, equals));
  for (const Origin& origin : origins_) {
    if (origin.is_assignment && (origin.key == name || origin.key.starts_with(name + "."))) {
      throw InputError(
          fmt::format("--set {}: would replace {}: give one of them", assignment, origin.source));
    }
  }

  YAML::Node parent = root_;
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    parent.reset(descend(parent, keys[i], assignment));
    if (parent.IsScalar()) {
      throw InputError(fmt::format("--set {}: '{}' holds no keys", assignment, keys[i]));
    }
  }
  if (parent.IsSequence()) {
    descend(parent, keys.back(), assignment) = value;
  } else {
    parent[keys.back()] = value;
  }
  origins_.push_back({name, fmt::format("--set {}", assignment), true, YAML::Mark::null_mark()});
}

std::string YamlDocument::place_of(const YAML::Node& node, std::string_view key) const {
  const Origin& origin = origin_of(key);
  if (origin.is_assignment) return origin.source;
  YAML::Mark mark = node ? node.Mark() : YAML::Mark::null_mark();
  if (mark.is_null() && node) {  // an assignment made it
    const auto below = std::find_if(origins_.rbegin(), origins_.rend(), [&](const Origin& one) {
      return one.is_assignment && one.key.starts_with(std::string(key) + ".");
    });
    if (below != origins_.rend()) return below->source;
    mark = origin.mark;
  }
  return mark.is_null() ? origin.source
                        : fmt::format("{}:{}:{}", origin.source, mark.line + 1, mark.column + 1);
}

const YamlDocument::Origin& YamlDocument::origin_of(std::string_view key) const {
  return *std::find_if(origins_.rbegin(), origins_.rend(), [&](const Origin& one) {
    return one.key.empty() || key == one.key || key.starts_with(one.key + ".");
  });
}

void YamlDocument::put_on(const YamlDocument& base) {
  origins_.clear();
  root_ = merged(root_, base.root_, "", base);
}

YAML::Node YamlDocument::merged(const YAML::Node& own, const YAML::Node& base,
                                const std::string& key, const YamlDocument& of_base) {
  YAML::Node both(YAML::NodeType::Map);
  origins_.push_back({key, name_, false, own.Mark()});
  // The order of the base stays, because the order of some keys is that of tables.
  for (const auto& entry : base) {
    const auto same = std::find_if(own.begin(), own.end(), [&](const auto& other) {
      return other.first.Scalar() == entry.first.Scalar();
    });
    const std::string path = (key.empty() ? "" : key + ".") + entry.first.Scalar();
    if (same == own.end()) {
      both.force_insert(entry.first, entry.second);
      origins_.push_back(of_base.origin_of(path));
      origins_.back().key = path;
      std::ranges::copy_if(of_base.origins_, std::back_inserter(origins_),
                           [&](const Origin& one) { return one.key.starts_with(path + "."); });
    } else if (same->second.IsMap() && entry.second.IsMap()) {
      both.force_insert(same->first, merged(same->second, entry.second, path, of_base));
    } else if (!same->second.IsNull()) {
      both.force_insert(same->first, same->second);
    }
  }
  for (const auto& entry : own) {
    if (!base[entry.first.Scalar()]) both.force_insert(entry.first, entry.second);
  }
  return both;
}

std::string not_one_of(std::string_view word, const std::vector<std::string>& candidates) {
  if (std::find(candidates.begin(), candidates.end(), word) != candidates.end()) return "";
  return fmt::format("'{}': expected {}{}", word, fmt::join(candidates, " or "),
                     did_you_mean(word, candidates));
}

}  // namespace touchdown
