#include "recordings/beliefs/numbers_csv.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"

namespace touchdown::recordings {

namespace {

struct Field {
  std::string_view text;   ///< without blanks around it
  std::size_t column = 1;  ///< of the line, from 1
};

std::vector<Field> fields_of(std::string_view line) {
  constexpr std::string_view blanks = " \t\r";
  std::vector<Field> fields;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    std::string_view text = line.substr(begin, end - begin);
    const std::size_t lead = std::min(text.find_first_not_of(blanks), text.size());
    text.remove_prefix(lead);
    text = text.substr(0, text.find_last_not_of(blanks) + 1);
    fields.push_back({text, begin + lead + 1});
    if (end == line.size()) return fields;
    begin = end + 1;
  }
}

std::optional<double> number_of(std::string_view text) {
  if (text == "true" || text == "True") return 1.0;
  if (text == "false" || text == "False") return 0.0;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Reads line after line and knows where it is.
class LineReader {
 public:
  LineReader(const std::filesystem::path& path, const NumbersCsv& taker)
      : file_(path.string()), taker_(taker) {}

  void take(std::string_view line) {
    ++line_;
    const std::vector<Field> fields = fields_of(line);
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

  void check(const std::optional<WrongBelief>& wrong, const std::vector<Field>& fields) const {
    if (!wrong) return;
    const std::size_t field = std::min(wrong->column, fields.size() - 1);
    complain(fields[field].column, wrong->what);
  }

  void take_names(const std::vector<Field>& fields) {
    std::vector<std::string> names;
    for (const Field& field : fields) names.emplace_back(field.text);
    check(taker_.names(names), fields);
    values_.resize(names.size());
  }

  void take_values(const std::vector<Field>& fields) {
    if (fields.size() != values_.size()) {
      complain(fields.back().column,
               fmt::format("expected {} values, found {}", values_.size(), fields.size()));
    }
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::optional<double> value = number_of(fields[i].text);
      if (!value)
        complain(fields[i].column, fmt::format("expected a number, found '{}'", fields[i].text));
      values_[i] = *value;
    }
    check(taker_.row(values_, line_), fields);
  }

  std::string file_;
  const NumbersCsv& taker_;
  std::vector<double> values_;
  std::size_t line_ = 0;
};

}  // namespace

void read_numbers_csv(const std::filesystem::path& path, const NumbersCsv& taker) {
  const std::string text = read_file(path);
  std::string_view rest = text;
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
  LineReader reader(path, taker);
  do {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    reader.take(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  } while (!rest.empty());
}

}  // namespace touchdown::recordings
