#include "tests/refusals/table.hpp"

#include <cctype>
#include <regex>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "tests/scratch_folder.hpp"

namespace touchdown::refusals {
namespace {

using Texts = std::vector<std::string>;

[[noreturn]] void reject(const YAML::Node& node, const std::string& words) {
  throw std::runtime_error(fmt::format("{}: {}", node.Mark().line + 1, words));
}

void check_keys(const YAML::Node& node, const std::set<std::string>& known) {
  if (!node.IsMap()) reject(node, "expected a mapping");
  for (const auto& entry : node) {
    if (!known.contains(entry.first.Scalar())) {
      reject(entry.first, fmt::format("unknown key '{}'", entry.first.Scalar()));
    }
  }
}

/// One text or several; none if there is no such key.
Texts texts_of(const YAML::Node& node) {
  if (!node) return {};
  return node.IsScalar() ? Texts{node.Scalar()} : node.as<Texts>();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::string edited(const std::string& text, const std::string& from, const std::string& to) {
  if (from.empty() || text.find(from) == std::string::npos) {
    throw std::runtime_error(fmt::format("there is no '{}' in the file", from));
  }
  return replaced(text, from, replaced(to, "$&", from));
}

std::string edited(std::string text, const YAML::Node& edits) {
  for (const auto& edit : edits) text = edited(text, edit.first.Scalar(), edit.second.Scalar());
  return text;
}

std::string content_of(const YAML::Node& file, const Names& names) {
  if (file.IsScalar()) return file.Scalar();
  check_keys(file, {"source", "made", "edits"});
  const std::string text =
      file["made"] ? names.texts.at(file["made"].Scalar())()
                   : read_file(fmt::format("{}/{}", TOUCHDOWN_SOURCE_DIR, file["source"].Scalar()));
  return edited(text, file["edits"]);
}

/// What a row adds to a changed file: nothing but its edits, or one of several texts.
struct Change {
  std::string key;  ///< to, add or text
  std::string text;
};

std::vector<Change> changes_of(const YAML::Node& row) {
  std::vector<Change> changes;
  for (const char* const key : {"to", "add", "text"}) {
    for (const std::string& text : texts_of(row[key])) changes.push_back({key, text});
  }
  if (changes.empty()) changes.push_back({"add", ""});
  return changes;
}

/// A group of rows, with what the table says about all groups.
class Group {
 public:
  Group(const YAML::Node& table, const YAML::Node& group, const Names& names) : group_(group) {
    check_keys(group, {"about", "reader", "files", "given", "from", "at", "refused", "taken"});
    const YAML::Node reader = group["reader"] ? group["reader"] : table["reader"];
    const auto found = names.readers.find(reader.Scalar());
    if (found == names.readers.end()) reject(group, "unknown reader '" + reader.Scalar() + "'");
    reader_ = found->second;
    for (const auto& file : group["files"]) {
      const std::string name = file.first.Scalar();
      files_[name] = content_of(file.second, names);
      if (changed_.empty()) changed_ = name;
    }
    given_ = group["given"] ? group["given"].Scalar() : changed_;
  }

  void check(const YAML::Node& row, bool is_refused, std::vector<Failure>& failures) const {
    check_keys(row, {"from", "to", "add", "text", "edits", "at", "says", "lacks"});
    for (const Change& change : changes_of(row)) {
      std::string failure;
      try {
        failure = failure_of(row, is_refused, complaint_about(input_of(row, change)));
      } catch (const std::exception& error) {
        failure = error.what();
      }
      if (!failure.empty()) {
        const std::string input = replaced(change.text.substr(0, 100), "\n", "\\n");
        failures.push_back({row.Mark().line + 1, fmt::format("'{}': {}", input, failure)});
      }
    }
  }

 private:
  YAML::Node own_or_groups(const YAML::Node& row, const char* key) const {
    return row[key] ? row[key] : group_[key];
  }

  std::string input_of(const YAML::Node& row, const Change& change) const {
    const std::string text = edited(files_.at(changed_), row["edits"]);
    if (change.key == "text") return change.text;
    if (change.key == "add") return text + change.text;
    return edited(text, own_or_groups(row, "from").as<std::string>(""), change.text);
  }

  /// The complaint about the files with this content of the changed one, without their folder;
  /// empty if there is none.
  std::string complaint_about(const std::string& input) const {
    const ScratchFolder folder;
    const auto write = [&](const std::string& name, const std::string& text) {
      folder.write(name, replaced(replaced(text, "<folder>", folder.path().string()), "<source>",
                                  TOUCHDOWN_SOURCE_DIR));
    };
    for (const auto& [name, text] : files_) write(name, name == changed_ ? input : text);
    try {
      reader_.read(folder / given_);
    } catch (const InputError& error) {
      return replaced(error.what(), folder.path().string() + "/", "");
    }
    return "";
  }

  /// What is wrong with a complaint; empty if nothing is.
  std::string failure_of(const YAML::Node& row, bool is_refused,
                         const std::string& complaint) const {
    if (!is_refused) return complaint.empty() ? "" : "is refused: " + complaint;
    if (complaint.empty()) return "is not refused";
    if (complaint.find('\n') != std::string::npos) return "more than one line: " + complaint;
    const std::string place = place_of(own_or_groups(row, "at"));
    if (!complaint.starts_with(place)) return fmt::format("not at '{}': {}", place, complaint);
    static const std::regex column("[^:]+:[0-9]+:[0-9]+: .+");
    if (reader_.names_columns && !std::regex_match(complaint, column)) {
      return "names no line and column: " + complaint;
    }
    const Texts words = texts_of(row["says"]);
    if (words.empty()) return "no words are expected of: " + complaint;
    for (const std::string& word : words) {
      if (complaint.find(word) == std::string::npos) {
        return fmt::format("does not say '{}': {}", word, complaint);
      }
    }
    for (const std::string& word : texts_of(row["lacks"])) {
      if (complaint.find(word) != std::string::npos) {
        return fmt::format("says '{}': {}", word, complaint);
      }
    }
    return "";
  }

  std::string place_of(const YAML::Node& at) const {
    if (!at) return changed_;
    const std::string& text = at.Scalar();
    const bool is_line = !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) != 0;
    return is_line ? fmt::format("{}:{}:", changed_, text) : text;
  }

  YAML::Node group_;
  Reader reader_;
  std::map<std::string, std::string> files_;
  std::string changed_;
  std::string given_;
};

}  // namespace

std::vector<Failure> failures_of(const YAML::Node& table, const Names& names) {
  check_keys(table, {"reader", "let", "groups"});
  std::vector<Failure> failures;
  for (const YAML::Node& node : table["groups"]) {
    const Group group(table, node, names);
    for (const YAML::Node& row : node["refused"]) group.check(row, true, failures);
    for (const YAML::Node& row : node["taken"]) group.check(row, false, failures);
  }
  return failures;
}

}  // namespace touchdown::refusals
