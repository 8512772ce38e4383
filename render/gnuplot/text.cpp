#include "render/gnuplot/text.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/table.hpp"

namespace touchdown::render {

std::string gnuplot_text(std::string_view text) {
  std::string result = "'";
  for (const char letter : text) {
    if (letter == '\n') {
      result += "'.\"\\n\".'";
    } else if (letter == '\'') {
      result += "'.\"'\".'";  // gnuplot's own '' fails at the beginning of a text
    } else if (letter == '@') {
      result += "'.\"\\100\".'";  // a macro's sign, even within quotes
    } else if (static_cast<unsigned char>(letter) >= 0x20) {
      result += letter;
    }
  }
  return result + "'";
}

std::string file_argument(const std::string& name) {
  const bool is_plain = !name.empty() && (std::isalnum(static_cast<unsigned char>(name[0])) != 0 ||
                                          static_cast<unsigned char>(name[0]) >= 0x80);
  return is_plain ? name : "./" + name;
}

std::string gnuplot_file(const std::string& name) { return gnuplot_text(file_argument(name)); }

std::string row_tics(const std::vector<std::string>& names) {
  std::string tics;
  for (std::size_t i = 0; i < names.size(); ++i) {
    tics += fmt::format("{}{} {}", i > 0 ? ", " : "", gnuplot_text(names[i]), names.size() - 1 - i);
  }
  return tics;
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "NaN"; }

std::string wrapped(std::string_view text, std::size_t columns) {
  std::string result;
  std::size_t used = 0;
  std::istringstream words{std::string(text)};
  for (std::string word; words >> word;) {
    const std::size_t letters = width(word);
    const bool goes_on = used > 0 && used + 1 + letters <= columns;
    if (used > 0) result += goes_on ? ' ' : '\n';
    result += word;
    used = goes_on ? used + 1 + letters : letters;
  }
  return result;
}

void PlotColumns::add(std::string name, std::vector<double> values) {
  if (!values_.empty() && values.size() != values_.front().size()) {
    throw Error(fmt::format("column {} has {} values, the others have {}", name, values.size(),
                            values_.front().size()));
  }
  names_.push_back(std::move(name));
  values_.push_back(std::move(values));
}

int PlotColumns::number_of(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) throw Error(fmt::format("there is no column {}", name));
  return static_cast<int>(found - names_.begin()) + 1;
}

std::string PlotColumns::text() const {
  std::string text = fmt::format("# {}\n", fmt::join(names_, "\t"));
  const std::size_t rows = values_.empty() ? 0 : values_.front().size();
  for (std::size_t row = 0; row < rows; ++row) {
    for (const std::vector<double>& column : values_) text.append(number(column[row])) += '\t';
    text.back() = '\n';
  }
  return text;
}

std::vector<double> in_ms(std::vector<double> seconds) {
  // Rounded to the nanosecond: the product alone would be 345.00000000000006.
  for (double& time : seconds) time = std::round(1e9 * time) / 1e6;
  return seconds;
}

std::string contact_bands(const std::vector<double>& time, const std::vector<bool>& contact) {
  std::string text = "unset object\nunset arrow\n";
  for (std::size_t begin = 0; begin < time.size();) {
    std::size_t end = begin + 1;
    while (end < time.size() && contact[end] == contact[begin]) ++end;
    const double until = end < time.size() ? time[end] : time.back();
    if (contact[begin]) {
      text += fmt::format(
          "set object rectangle from first {}, graph 0 to first {}, graph 1 behind "
          "fillcolor rgb '#dceee0' fillstyle solid noborder\n",
          time[begin], until);
    }
    if (end < time.size()) {
      text += fmt::format(
          "set arrow from first {0}, graph 0 to first {0}, graph 1 nohead front lw 1 dt 2 "
          "lc rgb '#5d666f'\n",
          until);
    }
    begin = end;
  }
  return text;
}

}  // namespace touchdown::render
