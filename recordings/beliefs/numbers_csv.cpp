#include "recordings/beliefs/numbers_csv.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/resources.hpp"

namespace touchdown::recordings {

namespace {

struct Field {
  std::string_view text;   ///< without surrounding blanks and quotes
  std::size_t column = 1;  ///< position in the line, from 1
  bool is_open = false;    ///< begins with a quote that is not closed
};

constexpr std::string_view blanks = " \t\r";

std::string_view without_blanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

/// The end of the quote at the beginning of a text. Two quote characters in a row stand for one.
std::size_t quote_end(std::string_view text) {
  std::size_t end = text.find('"', 1);
  while (end != std::string_view::npos && text.substr(end + 1, 1) == "\"") {
    end = text.find('"', end + 2);
  }
  return end;
}

std::vector<Field> fields_of(std::string_view line) {
  std::vector<Field> fields;
  std::size_t begin = 0;
  while (true) {
    begin = std::min(line.find_first_not_of(blanks, begin), line.size());
    const bool is_quoted = line.substr(begin, 1) == "\"";
    const std::size_t quoted = is_quoted ? quote_end(line.substr(begin)) : 0;
    const bool is_open = quoted == std::string_view::npos;
    const std::size_t end = std::min(line.find(',', is_open ? begin : begin + quoted), line.size());
    std::string_view text = without_blanks(line.substr(begin, end - begin));
    if (is_quoted && !is_open && text.size() == quoted + 1) text = text.substr(1, quoted - 1);
    fields.push_back({text, begin + 1, is_open});
    if (end == line.size()) return fields;
    begin = end + 1;
  }
}

std::string name_of(const Field& field) {
  std::string name(field.text);
  for (std::size_t at = name.find("\"\""); at != std::string::npos;
       at = name.find("\"\"", at + 1)) {
    name.erase(at, 1);
  }
  return name;
}

std::optional<double> number_of(std::string_view text) {
  if (text == "true" || text == "True") return 1.0;
  if (text == "false" || text == "False") return 0.0;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Reads one line after the other and counts them, for messages.
class LineReader {
 public:
  LineReader(const std::filesystem::path& path, const NumbersCsvSink& sink)
      : file_(path.string()), sink_(sink) {}

  void take(std::string_view line) {
    ++line_;
    const std::vector<Field> fields = fields_of(line);
    for (const Field& field : fields) {
      if (field.is_open) complain(field.column, "expected the end of a quote on the same line");
    }
    const bool is_blank = fields.size() == 1 && fields.front().text.empty();
    if (line_ == 1) {
      take_names(fields);
    } else if (!is_blank) {
      take_values(fields);
    }
  }

 private:
  [[noreturn]] void complain(std::size_t column, const std::string& what) const {
    throw InputError(fmt::format("{}:{}:{}: {}", file_, line_, column, what));
  }

  void check(const std::optional<ColumnError>& wrong, const std::vector<Field>& fields) const {
    if (!wrong) return;
    const std::size_t field = std::min(wrong->column, fields.size() - 1);
    complain(fields[field].column, wrong->what);
  }

  void take_names(const std::vector<Field>& fields) {
    std::vector<std::string> names;
    for (const Field& field : fields) names.push_back(name_of(field));
    check(sink_.names(names), fields);
    values_.resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      needed_.push_back(!sink_.needs || sink_.needs(i));
    }
  }

  void take_values(const std::vector<Field>& fields) {
    if (fields.size() != values_.size()) {
      complain(fields.back().column,
               fmt::format("expected {} values, found {}", values_.size(), fields.size()));
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (needed_[i]) values_[i] = value_of(fields[i]);
    }
    check(sink_.row(values_, line_), fields);
  }

  double value_of(const Field& field) const {
    const std::optional<double> value =
        field.text.empty() ? sink_.empty_cell : number_of(field.text);
    if (!value) complain(field.column, fmt::format("expected a number, found '{}'", field.text));
    return *value;
  }

  std::string file_;
  const NumbersCsvSink& sink_;
  std::vector<double> values_;
  std::vector<bool> needed_;
  std::size_t line_ = 0;
};

}  // namespace

void read_numbers_csv(const std::filesystem::path& path, const NumbersCsvSink& sink) {
  require_file(path);
  const std::string text = read_file(path);
  std::string_view rest = text;
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
  LineReader reader(path, sink);
  do {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    reader.take(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  } while (!rest.empty());
}

}  // namespace touchdown::recordings
