#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <sstream>
#include <string>
#include <sys/ioctl.h>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

#include "apps/cli/file_kinds.hpp"
#include "apps/cli/verb.hpp"
#include "core/key.hpp"
#include "core/program.hpp"
#include "core/table.hpp"

namespace touchdown::cli {

namespace {

constexpr std::size_t short_section = 2;  ///< as long as a reference to another section

/// The keys below key `i`, which follow it.
std::span<const Key> below(const std::vector<Key>& keys, std::size_t i) {
  const std::string& path = keys[i].path;
  std::size_t end = i + 1;
  while (end < keys.size() &&
         (keys[end].path.starts_with(path + ".") || keys[end].path.starts_with(path + "[]."))) {
    ++end;
  }
  return std::span(keys).subspan(i + 1, end - i - 1);
}

/// The key as its section has it, wherever the section is.
Key relative(Key key, const std::string& section) {
  key.path.erase(0, section.size());
  if (key.type.ends_with(" as " + section)) key.type.resize(key.type.size() - section.size());
  return key;
}

bool are_equal(std::span<const Key> keys, const std::string& section, std::span<const Key> others,
               const std::string& other_section) {
  return std::equal(keys.begin(), keys.end(), others.begin(), others.end(),
                    [&](const Key& key, const Key& other) {
                      return relative(key, section) == relative(other, other_section);
                    });
}

/// Replaces the keys of a section that an earlier section has, too, by a reference to that one in
/// the section's type. Sections of one or two keys are kept.
std::vector<Key> without_repeats(const std::vector<Key>& keys) {
  std::vector<Key> kept;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    Key& key = kept.emplace_back(keys[i]);
    const std::span<const Key> inner = below(keys, i);
    if (inner.size() <= short_section) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (!are_equal(inner, key.path, below(keys, j), keys[j].path)) continue;
      key.type += " as " + keys[j].path;
      i += inner.size();
      break;
    }
  }
  return kept;
}

/// The text in lines of at most `columns` characters; longer words get a line of their own.
std::vector<std::string> wrapped(const std::string& text, std::size_t columns) {
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.back().empty() && width(lines.back()) + 1 + width(word) > columns) {
      lines.emplace_back();
    }
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  return lines;
}

/// "number (N), 0 to 10; default 1"
std::string value_line(const Key& key) {
  std::string line = key.type;
  if (!key.unit.empty()) line += fmt::format(" ({})", key.unit);
  if (!key.range.empty()) line += ", " + key.range;
  if (key.fallback == "required") return line + "; required";
  return key.fallback.empty() ? line : line + "; default: " + key.fallback;
}

std::string escaped(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.insert(at, "\\");
  }
  return text;
}

/// The keys of a kind of file for a terminal of `columns` characters: each key, and beside it its
/// type, unit, range and default, then its meaning.
std::string reference_text(const FileKind& kind, std::size_t columns) {
  const std::vector<Key> keys = without_repeats(kind.keys());
  std::size_t longest = 0;
  for (const Key& key : keys) longest = std::max(longest, width(key.path));
  const std::size_t margin = std::min(longest, columns * 2 / 5) + 2;
  std::string text = kind.title + "\n";
  for (const std::string& line : wrapped(kind.usage, columns)) text += line + "\n";
  text += "[]: any item of a list. none: no value, or off.\n";
  for (const Key& key : keys) {
    std::vector<std::string> lines = wrapped(value_line(key), columns - margin);
    for (std::string& line : wrapped(key.meaning, columns - margin)) {
      lines.push_back(std::move(line));
    }
    const bool fits = width(key.path) + 2 <= margin;
    if (key.path.find('.') == std::string::npos) text += "\n";
    text += key.path + (fits ? std::string(margin - width(key.path), ' ') : "\n");
    for (std::size_t i = 0; i < lines.size(); ++i) {
      text += (i == 0 && fits ? "" : std::string(margin, ' ')) + lines[i] + "\n";
    }
  }
  return text;
}

/// The same as a section of a Markdown document, with one table.
std::string reference_markdown(const FileKind& kind) {
  std::string text = fmt::format("## {}\n\n{}\n\n", kind.title, kind.usage);
  text += "| key | type | unit | range | default | |\n|---|---|---|---|---|---|\n";
  for (const Key& key : without_repeats(kind.keys())) {
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.path, escaped(key.type),
                        escaped(key.unit), escaped(key.range), escaped(key.fallback),
                        escaped(key.meaning));
  }
  return text;
}

std::string reference_document() {
  std::string text =
      "# Every key of every file\n\n"
      "Generated by `touchdown list keys --markdown > docs/reference/keys.md`. `touchdown list "
      "scenario` prints one kind of file in the terminal.\n\n"
      "Paths are dotted. `[]` stands for any item of a list; `--set` takes its number, from 0: "
      "`--set terrain.pieces.1.stairs.rise=0.15`. A section \"as\" another one has the same keys. "
      "\"none\" means that an absent key has no value, or that the feature of an absent section is "
      "off.\n";
  for (const FileKind& kind : file_kinds()) text += "\n" + reference_markdown(kind);
  return text;
}

/// The width of the terminal, within what is readable; 100 if the output is a file or a pipe.
std::size_t terminal_columns() {
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 100;
  return std::clamp<std::size_t>(size.ws_col, 60, 120);
}

}  // namespace

std::string keys_reference(const std::string& kind, bool markdown) {
  const bool all = kind == "keys";
  if (markdown) return all ? reference_document() : reference_markdown(file_kind(kind));
  if (!all) return reference_text(file_kind(kind), terminal_columns());
  std::vector<std::string> texts;
  for (const FileKind& one : file_kinds()) {
    texts.push_back(reference_text(one, terminal_columns()));
  }
  return fmt::format("{}", fmt::join(texts, "\n\n"));
}

}  // namespace touchdown::cli
